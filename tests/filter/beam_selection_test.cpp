#include "filter/beam_selection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace sketchloc {
namespace {

Scan half_turn_scan(std::size_t readings, float range_m) {
  Scan scan;
  scan.first_angle_rad = -std::numbers::pi / 2.0;
  scan.angle_step_rad = std::numbers::pi / static_cast<double>(readings - 1);
  scan.max_range_m = 80.0;
  scan.ranges_m.assign(readings, range_m);
  return scan;
}

TEST(SelectBeams, SpreadsThemOverTheFieldOfView) {
  std::vector<SelectedBeam> beams;
  select_beams(beams, half_turn_scan(181, 2.0F), {.beams = 3});
  ASSERT_EQ(beams.size(), 3U);
  EXPECT_NEAR(std::atan2(beams[0].end_in_robot.y(), beams[0].end_in_robot.x()),
              -std::numbers::pi / 3.0, 0.02);
  EXPECT_TRUE(beams[1].end_in_robot.isApprox(Eigen::Vector2d(2.0, 0.0), 0.02));
  EXPECT_NEAR(std::atan2(beams[2].end_in_robot.y(), beams[2].end_in_robot.x()),
              std::numbers::pi / 3.0, 0.02);
}

TEST(SelectBeams, LeavesOutWhatIsNoRange) {
  Scan scan = half_turn_scan(3, 5.0F);
  scan.min_range_m = 0.1;
  scan.ranges_m = {std::numeric_limits<float>::quiet_NaN(), 0.05F, 0.0F};
  std::vector<SelectedBeam> beams;
  select_beams(beams, scan, {.beams = 3});
  EXPECT_EQ(beams.size(), 0U);
}

TEST(SelectBeams, KeepsWhatSawNothingAsFarAsItSaw) {
  Scan scan = half_turn_scan(4, 5.0F);
  scan.ranges_m = {25.0F, 81.0F, std::numeric_limits<float>::infinity(), 19.0F};
  std::vector<SelectedBeam> beams;
  select_beams(beams, scan, {.beams = 4, .max_range_m = 20.0});
  ASSERT_EQ(beams.size(), 4U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(beams[i].returned);
    EXPECT_NEAR(beams[i].end_in_robot.norm(), 20.0, 1e-9);
  }
  EXPECT_TRUE(beams[3].returned);
}

TEST(SelectBeams, SawNothingFartherThanTheSensorReaches) {
  Scan scan = half_turn_scan(3, std::numeric_limits<float>::infinity());
  scan.max_range_m = 5.6;
  std::vector<SelectedBeam> beams;
  select_beams(beams, scan, {.beams = 1});
  ASSERT_EQ(beams.size(), 1U);
  EXPECT_FALSE(beams[0].returned);
  EXPECT_NEAR(beams[0].end_in_robot.norm(), 5.6, 1e-9);
}

TEST(SelectBeams, TakesEveryReadingWhereThereAreFewer) {
  std::vector<SelectedBeam> beams;
  select_beams(beams, half_turn_scan(5, 2.0F), {.beams = 60});
  EXPECT_EQ(beams.size(), 5U);
  select_beams(beams, Scan(), {});
  EXPECT_EQ(beams.size(), 0U);
}

TEST(SelectBeams, SeesFromTheRobotNotFromTheLaser) {
  Scan scan = half_turn_scan(3, 2.0F);
  scan.robot_from_laser = Se2::from_xy_yaw(1.0, 0.0, std::numbers::pi);  // looks back
  std::vector<SelectedBeam> beams;
  select_beams(beams, scan, {.beams = 3});
  ASSERT_EQ(beams.size(), 3U);
  EXPECT_TRUE(beams[1].end_in_robot.isApprox(Eigen::Vector2d(-1.0, 0.0), 1e-6));  // at x = 1 - 2
}

TEST(BeamSelection, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(validate(BeamSelection{.beams = 0}), std::invalid_argument);
  EXPECT_THROW(validate(BeamSelection{.max_range_m = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

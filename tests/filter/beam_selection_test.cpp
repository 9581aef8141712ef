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
  std::vector<Beam> beams;
  select_beams(beams, half_turn_scan(181, 2.0F), {.beams = 3});
  ASSERT_EQ(beams.size(), 3U);
  EXPECT_NEAR(beams[0].bearing_rad, -std::numbers::pi / 3.0, 0.02);
  EXPECT_NEAR(beams[1].bearing_rad, 0.0, 0.02);
  EXPECT_NEAR(beams[2].bearing_rad, std::numbers::pi / 3.0, 0.02);
  EXPECT_NEAR(beams[1].range_m, 2.0, 1e-6);
}

TEST(SelectBeams, LeavesOutWhatDidNotReturnOrIsTooFar) {
  Scan scan = half_turn_scan(3, 5.0F);
  scan.ranges_m = {std::numeric_limits<float>::quiet_NaN(), 25.0F, 0.0F};
  std::vector<Beam> beams;
  select_beams(beams, scan, {.beams = 3, .max_range_m = 20.0});
  EXPECT_EQ(beams.size(), 0U);
}

TEST(SelectBeams, TakesEveryReadingWhereThereAreFewer) {
  std::vector<Beam> beams;
  select_beams(beams, half_turn_scan(5, 2.0F), {.beams = 60});
  EXPECT_EQ(beams.size(), 5U);
  select_beams(beams, Scan(), {});
  EXPECT_EQ(beams.size(), 0U);
}

TEST(SelectBeams, SeesFromTheRobotNotFromTheLaser) {
  Scan scan = half_turn_scan(3, 2.0F);
  scan.robot_from_laser = Se2::from_xy_yaw(1.0, 0.0, std::numbers::pi);  // looks back
  std::vector<Beam> beams;
  select_beams(beams, scan, {.beams = 3});
  ASSERT_EQ(beams.size(), 3U);
  EXPECT_NEAR(std::abs(beams[1].bearing_rad), std::numbers::pi, 1e-6);  // middle reading
  EXPECT_NEAR(beams[1].range_m, 1.0, 1e-6);                             // at x = 1 - 2
}

TEST(BeamSelection, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(validate(BeamSelection{.beams = 0}), std::invalid_argument);
  EXPECT_THROW(validate(BeamSelection{.max_range_m = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

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

TEST(SelectEndPoints, SpreadsThemOverTheFieldOfView) {
  std::vector<Eigen::Vector2d> ends;
  select_end_points(ends, half_turn_scan(181, 2.0F), {.beams = 3});
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_NEAR(std::atan2(ends[0].y(), ends[0].x()), -std::numbers::pi / 3.0, 0.02);
  EXPECT_TRUE(ends[1].isApprox(Eigen::Vector2d(2.0, 0.0), 0.02));
  EXPECT_NEAR(std::atan2(ends[2].y(), ends[2].x()), std::numbers::pi / 3.0, 0.02);
}

TEST(SelectEndPoints, LeavesOutWhatDidNotReturnOrIsTooFar) {
  Scan scan = half_turn_scan(3, 5.0F);
  scan.ranges_m = {std::numeric_limits<float>::quiet_NaN(), 25.0F, 0.0F};
  std::vector<Eigen::Vector2d> ends;
  select_end_points(ends, scan, {.beams = 3, .max_range_m = 20.0});
  EXPECT_EQ(ends.size(), 0U);
}

TEST(SelectEndPoints, TakesEveryReadingWhereThereAreFewer) {
  std::vector<Eigen::Vector2d> ends;
  select_end_points(ends, half_turn_scan(5, 2.0F), {.beams = 60});
  EXPECT_EQ(ends.size(), 5U);
  select_end_points(ends, Scan(), {});
  EXPECT_EQ(ends.size(), 0U);
}

TEST(SelectEndPoints, SeesFromTheRobotNotFromTheLaser) {
  Scan scan = half_turn_scan(3, 2.0F);
  scan.robot_from_laser = Se2::from_xy_yaw(1.0, 0.0, std::numbers::pi);  // looks back
  std::vector<Eigen::Vector2d> ends;
  select_end_points(ends, scan, {.beams = 3});
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_TRUE(ends[1].isApprox(Eigen::Vector2d(-1.0, 0.0), 1e-6));  // at x = 1 - 2
}

TEST(BeamSelection, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(validate(BeamSelection{.beams = 0}), std::invalid_argument);
  EXPECT_THROW(validate(BeamSelection{.max_range_m = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

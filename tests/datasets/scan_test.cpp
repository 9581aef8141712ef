#include "datasets/scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sketchloc {
namespace {

constexpr double kPi = std::numbers::pi;

Scan three_beams() {  // right, ahead, left
  return {.first_angle_rad = -kPi / 2.0,
          .angle_step_rad = kPi / 2.0,
          .min_range_m = 0.1,
          .max_range_m = 10.0,
          .robot_from_laser = Se2(),
          .ranges_m = {1.0f, 2.0f, 3.0f}};
}

TEST(Scan, TurnsCounterClockwiseFromItsFirstBeam) {
  const Scan scan = three_beams();
  EXPECT_DOUBLE_EQ(scan.angle_rad(0), -kPi / 2.0);
  EXPECT_DOUBLE_EQ(scan.angle_rad(1), 0.0);
  EXPECT_DOUBLE_EQ(scan.angle_rad(2), kPi / 2.0);
}

TEST(Scan, TakesRangesFromMinimumUpToMaximumAsReturns) {
  Scan scan = three_beams();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  scan.ranges_m = {0.125f, 9.999f, 10.0f, 0.0f, -1.0f, kInfinity, std::nanf("")};
  scan.min_range_m = 0.125;
  const std::vector<bool> expected = {true, true, false, false, false, false, false};
  for (std::size_t beam = 0; beam < expected.size(); ++beam) {
    EXPECT_EQ(scan.is_return(beam), expected[beam]) << scan.ranges_m[beam];
  }
}

TEST(Scan, TakesAReadingOfTheLargestRangeForNoReturnHoweverItIsRounded) {
  Scan scan = three_beams();
  for (const double max_range_m : {5.6, 4.095, 81.92, 29.9, 79.99, 80.0, 81.91}) {
    scan.max_range_m = max_range_m;
    scan.ranges_m[0] = static_cast<float>(max_range_m);
    EXPECT_FALSE(scan.is_return(0)) << max_range_m;
    scan.ranges_m[0] = std::nextafter(scan.ranges_m[0], 0.0F);
    EXPECT_TRUE(scan.is_return(0)) << max_range_m;
  }
}

TEST(Scan, TakesTheSmallestRangeForAReturnHoweverItIsRounded) {
  Scan scan = three_beams();
  for (const double min_range_m : {0.02, 0.05, 0.1, 0.06}) {
    scan.min_range_m = min_range_m;
    scan.ranges_m[0] = static_cast<float>(min_range_m);
    EXPECT_TRUE(scan.is_return(0)) << min_range_m;
  }
}

TEST(Scan, TakesARangeOfZeroForNoReturnEvenWithoutASmallestRange) {
  Scan scan = three_beams();
  scan.min_range_m = 0.0;
  scan.ranges_m = {0.0F, 1e-3F, -1.0F};
  EXPECT_FALSE(scan.is_return(0));
  EXPECT_TRUE(scan.is_return(1));
  EXPECT_FALSE(scan.is_return(2));
}

TEST(EndPoints, LieAheadAndToTheLeftInTheRobotFrame) {
  const std::vector<Eigen::Vector2d> points = end_points_in_robot(three_beams());
  ASSERT_EQ(points.size(), 3u);
  EXPECT_TRUE(points[0].isApprox(Eigen::Vector2d(0.0, -1.0), 1e-12));
  EXPECT_TRUE(points[1].isApprox(Eigen::Vector2d(2.0, 0.0), 1e-12));
  EXPECT_TRUE(points[2].isApprox(Eigen::Vector2d(0.0, 3.0), 1e-12));
}

TEST(EndPoints, StartFromWhereTheLaserIsMounted) {
  Scan scan = three_beams();
  scan.robot_from_laser = Se2::from_xy_yaw(0.5, 0.2, kPi);  // looks back
  EXPECT_TRUE(end_points_in_robot(scan)[1].isApprox(Eigen::Vector2d(-1.5, 0.2), 1e-12));
}

TEST(EndPoints, LeaveOutBeamsWithoutReturn) {
  Scan scan = three_beams();
  scan.ranges_m = {std::nanf(""), 2.0f, 10.0f};
  ASSERT_EQ(end_points_in_robot(scan).size(), 1u);
  scan.ranges_m.clear();
  EXPECT_TRUE(end_points_in_robot(scan).empty());
}

}  // namespace
}  // namespace sketchloc

#include "planning/follower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sketchloc {
namespace {

/// A scan all around: a wall two metres ahead from y = -1 to `to_y_m`, nothing else.
Scan wall_ahead(double to_y_m) {
  Scan scan;
  scan.first_angle_rad = -std::numbers::pi;
  scan.angle_step_rad = std::numbers::pi / 360.0;
  scan.min_range_m = 0.05;
  scan.max_range_m = 30.0;
  for (std::size_t beam = 0; beam < 720; ++beam) {
    const double angle_rad = scan.angle_rad(beam);
    const double y_m = 2.0 * std::tan(angle_rad);
    const bool hits = std::abs(angle_rad) < 1.5 && y_m >= -1.0 && y_m <= to_y_m;
    scan.ranges_m.push_back(hits ? static_cast<float>(2.0 / std::cos(angle_rad)) : 30.0F);
  }
  return scan;
}

NextStep step_along(const PathPoints& path, const Scan& scan) {
  NearbyObstacles obstacles{NearbyParams{}};
  obstacles.add(scan, {});
  return next_step(path, obstacles, {}, {});
}

TEST(Follower, DrivesStraightWhereNothingIsInTheWay) {
  const NextStep step = step_along({{0.0, 0.0}, {1.5, 0.0}}, wall_ahead(-2.0));
  ASSERT_EQ(step.status, NextStep::Status::Drives);
  EXPECT_NEAR(step.robot_from_next.x_m(), 0.2, 0.01);
  EXPECT_NEAR(step.robot_from_next.y_m(), 0.0, 0.02);
}

TEST(Follower, TurnsOnTheSpotFirst) {
  const NextStep step = step_along({{0.0, 0.0}, {0.0, 1.5}}, wall_ahead(-2.0));
  ASSERT_EQ(step.status, NextStep::Status::Drives);
  EXPECT_EQ(step.robot_from_next.translation().norm(), 0.0);
  EXPECT_NEAR(step.robot_from_next.yaw_rad(), 0.5, 1e-9);
}

TEST(Follower, GoesAroundWhatIsNotDrawn) {
  const NextStep step = step_along({{0.0, 0.0}, {3.0, 0.0}}, wall_ahead(0.3));
  ASSERT_EQ(step.status, NextStep::Status::Drives);
  EXPECT_GT(step.robot_from_next.yaw_rad(), 0.1);  // to the left, around its near end
}

TEST(Follower, ArrivesAtTheEndOfTheWay) {
  EXPECT_EQ(step_along({{0.0, 0.0}, {0.02, 0.0}}, wall_ahead(0.3)).status,
            NextStep::Status::Arrived);
}

TEST(Follower, IsBlockedWithoutAWay) {
  EXPECT_EQ(step_along({}, wall_ahead(0.3)).status, NextStep::Status::Blocked);
  EXPECT_THROW(validate(FollowerParams{.step_m = 0.0}), std::invalid_argument);
}

TEST(NearbyObstacles, ForgetOldScansAndLonelyReturns) {
  NearbyObstacles obstacles{NearbyParams{.max_scans = 1}};
  obstacles.add(wall_ahead(0.3), {});
  const auto occupied = [&](const Se2& odom_from_robot) {
    std::size_t count = 0;
    const Sketch window = obstacles.around(odom_from_robot);
    for (const std::uint8_t cell : window.occupied.cells()) {
      count += cell;
    }
    return count;
  };
  const Eigen::Vector2d ahead = obstacles.cells_from_robot({2.0, 0.0});
  EXPECT_TRUE(obstacles.robot_from_cells(ahead).isApprox(Eigen::Vector2d(2.0, 0.0)));
  EXPECT_EQ(obstacles.around({}).occupied.at(cell_at(ahead)), 1);
  EXPECT_EQ(occupied(Se2::from_xy_yaw(20.0, 0.0, 0.0)), 0U);
  Scan lonely = wall_ahead(-2.0);
  lonely.ranges_m[360] = 1.0F;
  obstacles.add(lonely, {});
  EXPECT_EQ(occupied({}), 0U);
}

}  // namespace
}  // namespace sketchloc

#include "registration/surface_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/support/segment_world.hpp"

namespace sketchloc {
namespace {

using testing::endless_corridor;
using testing::furnished_room;
using testing::half_turn_scan;
using testing::scan_from;

Scan corridor_scan() {
  Rng rng = make_rng(1);
  return scan_from(endless_corridor(), Se2(), 0.0, rng);
}

TEST(SurfacePoints, LieOnTheWallsWithNormalsTowardsTheLaser) {
  const std::vector<SurfacePoint> points = surface_points_in_robot(corridor_scan());
  EXPECT_GT(points.size(), 50U);
  for (const SurfacePoint& surface : points) {
    EXPECT_NEAR(std::abs(surface.point.y()), 1.0, 1e-5);
    EXPECT_NEAR(surface.normal.x(), 0.0, 1e-4);
    EXPECT_NEAR(surface.normal.y(), -surface.point.y(), 1e-4);
  }
}

TEST(SurfacePoints, KeepTheirDistanceAndTheRangeLimit) {
  const SurfaceParams params{.max_range_m = 5.0, .spacing_m = 0.2};
  const std::vector<SurfacePoint> points = surface_points_in_robot(corridor_scan(), params);
  ASSERT_FALSE(points.empty());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(points[i].point.norm(), 5.0 + 1e-5);
    if (i > 0) {
      EXPECT_GE((points[i].point - points[i - 1].point).norm(), 0.2);
    }
  }
}

TEST(SurfacePoints, AreGivenInTheRobotFrameWhateverTheMountingOfTheLaser) {
  const Se2 robot_from_laser = Se2::from_xy_yaw(0.3, 0.1, std::numbers::pi / 2);
  Scan scan = corridor_scan();
  const std::vector<SurfacePoint> in_laser = surface_points_in_robot(scan);
  scan.robot_from_laser = robot_from_laser;
  const std::vector<SurfacePoint> in_robot = surface_points_in_robot(scan);
  ASSERT_EQ(in_robot.size(), in_laser.size());
  for (std::size_t i = 0; i < in_robot.size(); ++i) {
    EXPECT_TRUE(in_robot[i].point.isApprox(robot_from_laser * in_laser[i].point, 1e-9));
    const Eigen::Vector2d turned = robot_from_laser.rotation_matrix() * in_laser[i].normal;
    EXPECT_TRUE(in_robot[i].normal.isApprox(turned, 1e-9));
  }
}

TEST(SurfacePoints, LeaveOutLonelyPointsAndWhatDidNotReturn) {
  Scan scan = half_turn_scan();
  scan.ranges_m.assign(181, std::numeric_limits<float>::quiet_NaN());
  scan.ranges_m[40] = std::numeric_limits<float>::infinity();
  scan.ranges_m[60] = -1.0F;
  scan.ranges_m[90] = 2.0F;
  EXPECT_TRUE(surface_points_in_robot(scan).empty());
  EXPECT_TRUE(surface_points_in_robot(half_turn_scan()).empty());
}

TEST(SurfacePoints, SurviveAllBeamsInOnePoint) {
  Scan scan = half_turn_scan();
  scan.angle_step_rad = 0.0;
  scan.ranges_m.assign(181, 2.0F);
  for (const SurfacePoint& surface : surface_points_in_robot(scan)) {
    EXPECT_TRUE(surface.normal.allFinite());
  }
}

TEST(SurfacePoints, RefuseParametersOutOfRange) {
  EXPECT_THROW(validate(SurfaceParams{.max_range_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(SurfaceParams{.max_roughness = 1.5}), std::invalid_argument);
  EXPECT_NO_THROW(validate(SurfaceParams{}));
}

}  // namespace
}  // namespace sketchloc

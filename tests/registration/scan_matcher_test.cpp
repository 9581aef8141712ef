#include "registration/scan_matcher.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "motion/odometry.hpp"
#include "motion/random.hpp"
#include "registration/matched_odometry.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

struct Segment {
  Eigen::Vector2d from_in_world;
  Eigen::Vector2d to_in_world;
};
using World = std::vector<Segment>;

World room() {
  return {{{-4, -3}, {5, -3}}, {{5, -3}, {5, 4}},     {{5, 4}, {-4, 4}},       {{-4, 4}, {-4, -3}},
          {{3, 1}, {4, 1}},    {{4, 1}, {4, 2}},      {{4, 2}, {3, 2}},        {{3, 2}, {3, 1}},
          {{-4, 0}, {-2, 0}},  {{-2, 0}, {-2, -0.2}}, {{-2, -0.2}, {-4, -0.2}}};
}

World corridor() { return {{{-100, -1}, {100, -1}}, {{-100, 1}, {100, 1}}}; }

double range_m(const World& world, const Eigen::Vector2d& origin, double heading_rad) {
  const Eigen::Vector2d ray(std::cos(heading_rad), std::sin(heading_rad));
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Segment& segment : world) {
    const Eigen::Vector2d along = segment.to_in_world - segment.from_in_world;
    const Eigen::Vector2d offset = segment.from_in_world - origin;
    const double turn = ray.x() * along.y() - ray.y() * along.x();
    const double way_m = (offset.x() * along.y() - offset.y() * along.x()) / turn;
    const double share = (offset.x() * ray.y() - offset.y() * ray.x()) / turn;
    if (share >= 0.0 && share <= 1.0 && way_m > 0.0) {
      nearest_m = std::min(nearest_m, way_m);
    }
  }
  return nearest_m;
}

/// No beams yet: 180 deg from right to left, one per degree.
Scan half_turn_scan() {
  Scan scan;
  scan.first_angle_rad = -std::numbers::pi / 2;
  scan.angle_step_rad = std::numbers::pi / 180;
  scan.max_range_m = 20.0;
  return scan;
}

Scan scan_from(const World& world, const Se2& world_from_robot, double noise_m, Rng& rng) {
  Scan scan = half_turn_scan();
  for (std::size_t beam = 0; beam < 181; ++beam) {
    const double heading_rad = world_from_robot.yaw_rad() + scan.angle_rad(beam);
    const double exact_m = range_m(world, world_from_robot.translation(), heading_rad);
    scan.ranges_m.push_back(static_cast<float>(exact_m + gaussian(noise_m, rng)));
  }
  return scan;
}

TEST(MatchedOdometry, FindsTheWayThroughARoomDespiteWheelsThatAreOffBy20Percent) {
  Rng rng = make_rng(1);
  MatchedOdometry odometry;
  Se2 world_from_robot;
  Se2 raw;
  MatchedStep step = odometry.step(scan_from(room(), world_from_robot, 0.01, rng), raw);
  EXPECT_EQ(step.status, MatchedStep::Status::First);
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d twist(0.25, 0.0, 0.2);
    world_from_robot = world_from_robot * Se2::exp(twist);
    raw = raw * Se2::exp(1.2 * twist);
    step = odometry.step(scan_from(room(), world_from_robot, 0.01, rng), raw);
    EXPECT_EQ(step.status, MatchedStep::Status::Matched);
    ASSERT_THAT(step.odom_from_robot, IsNear(world_from_robot, 0.05)) << "step " << i;
  }
}

TEST(MatchedOdometry, FollowsTheWheelsAlongACorridorWithoutEndAndSaysSo) {
  Rng rng = make_rng(2);
  MatchedOdometry odometry;
  Se2 world_from_robot;
  odometry.step(scan_from(corridor(), world_from_robot, 0.0, rng), world_from_robot);
  for (int i = 0; i < 20; ++i) {
    world_from_robot = world_from_robot * Se2::from_xy_yaw(0.3, 0.0, 0.0);
    const Se2 raw = world_from_robot;
    const MatchedStep step = odometry.step(scan_from(corridor(), world_from_robot, 0.01, rng), raw);
    EXPECT_EQ(step.status, MatchedStep::Status::Degenerate);
    EXPECT_GT(step.covariance(0, 0), 4.0 * step.covariance(1, 1));
    ASSERT_THAT(step.odom_from_robot, IsNear(world_from_robot, 0.1)) << "step " << i;
  }
}

TEST(MatchedOdometry, FallsBackToTheWheelsOnEmptyScansAndNaN) {
  const Scan empty = half_turn_scan();
  Scan nan = empty;
  nan.ranges_m.assign(181, std::numeric_limits<float>::quiet_NaN());
  MatchedOdometry odometry;
  Se2 raw;
  for (const Scan& scan : {empty, nan, empty, nan}) {
    const MatchedStep step = odometry.step(scan, raw);
    EXPECT_NE(step.status, MatchedStep::Status::Matched);
    EXPECT_THAT(step.odom_from_robot, IsNear(raw, 1e-12));
    raw = raw * Se2::exp({0.3, 0.0, 0.1});
  }
}

}  // namespace
}  // namespace sketchloc

#include "registration/matched_odometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "motion/odometry.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/segment_world.hpp"

namespace sketchloc {
namespace {

using testing::endless_corridor;
using testing::furnished_room;
using testing::half_turn_scan;
using testing::IsNear;
using testing::scan_from;

const Eigen::Vector3d kCurve(0.25, 0.0, 0.2);  // one step of a circle around (0, 1.25) in the room

TEST(MatchedOdometry, FindsTheWayThroughARoomDespiteWheelsThatAreOffBy20Percent) {
  Rng rng = make_rng(1);
  MatchedOdometry odometry;
  Se2 world_from_robot;
  Se2 raw;
  MatchedStep step = odometry.step(scan_from(furnished_room(), world_from_robot, 0.01, rng), raw);
  EXPECT_EQ(step.status, MatchedStep::Status::First);
  for (int i = 0; i < 40; ++i) {
    world_from_robot = world_from_robot * Se2::exp(kCurve);
    raw = raw * Se2::exp(1.2 * kCurve);
    step = odometry.step(scan_from(furnished_room(), world_from_robot, 0.01, rng), raw);
    EXPECT_EQ(step.status, MatchedStep::Status::Matched);
    ASSERT_THAT(step.odom_from_robot, IsNear(world_from_robot, 0.03)) << "step " << i;
  }
}

TEST(MatchedOdometry, FindsATurnThatTheWheelsMissed) {
  Rng rng = make_rng(2);
  MatchedOdometry odometry;
  odometry.step(scan_from(furnished_room(), Se2(), 0.01, rng), Se2());
  const Se2 world_from_robot = Se2::from_xy_yaw(0.3, 0.2, 0.45);
  const MatchedStep step =
      odometry.step(scan_from(furnished_room(), world_from_robot, 0.01, rng), Se2());
  EXPECT_EQ(step.status, MatchedStep::Status::Matched);
  EXPECT_THAT(step.odom_from_robot, IsNear(world_from_robot, 0.02));
}

TEST(MatchedOdometry, StartsAtTheFirstRawPoseAndAddsUpItsIncrements) {
  Rng rng = make_rng(3);
  const Se2 start = Se2::from_xy_yaw(100.0, -50.0, 2.0);
  MatchedOdometry odometry;
  Se2 world_from_robot;
  const auto see = [&] { return scan_from(furnished_room(), world_from_robot, 0.01, rng); };
  Se2 sum = odometry.step(see(), start).odom_from_robot;
  EXPECT_THAT(sum, IsNear(start, 0.0));
  for (int i = 0; i < 10; ++i) {
    world_from_robot = world_from_robot * Se2::exp(kCurve);
    const MatchedStep step = odometry.step(see(), start * world_from_robot);
    sum = sum * step.previous_from_robot;
    EXPECT_THAT(step.odom_from_robot, IsNear(sum, 1e-9));
  }
}

TEST(MatchedOdometry, FollowsTheWheelsAlongACorridorWithoutEndAndSaysSo) {
  Rng rng = make_rng(4);
  MatchedOdometry odometry;
  Se2 world_from_robot;
  odometry.step(scan_from(endless_corridor(), world_from_robot, 0.0, rng), world_from_robot);
  for (int i = 0; i < 20; ++i) {
    world_from_robot = world_from_robot * Se2::from_xy_yaw(0.3, 0.0, 0.0);
    const MatchedStep step =
        odometry.step(scan_from(endless_corridor(), world_from_robot, 0.01, rng), world_from_robot);
    EXPECT_EQ(step.status, MatchedStep::Status::Degenerate);
    EXPECT_GT(step.covariance(0, 0), 4.0 * step.covariance(1, 1));
    ASSERT_THAT(step.odom_from_robot, IsNear(world_from_robot, 0.1)) << "step " << i;
  }
}

TEST(MatchedOdometry, FallsBackToTheWheelsOnEmptyScansAndNaN) {
  Scan nan = half_turn_scan();
  nan.ranges_m.assign(181, std::numeric_limits<float>::quiet_NaN());
  MatchedOdometry odometry;
  Se2 raw;
  odometry.step(half_turn_scan(), raw);
  for (const Scan& scan : {nan, half_turn_scan(), nan}) {
    raw = raw * Se2::exp(kCurve);
    const MatchedStep step = odometry.step(scan, raw);
    EXPECT_EQ(step.status, MatchedStep::Status::TooFewPoints);
    EXPECT_THAT(step.odom_from_robot, IsNear(raw, 1e-12));
    EXPECT_GT(step.covariance.determinant(), 0.0);
  }
}

TEST(MatchedOdometry, RejectsAPlaceItHasNeverSeenAndGoesOnFromThere) {
  Rng rng = make_rng(5);
  MatchedOdometry odometry;
  Se2 world_from_robot;
  const auto see = [&](double shift_m) {  // the same robot in another room of the world
    testing::World world = furnished_room();
    for (testing::Wall& wall : world) {
      wall.from_in_world = wall.from_in_world * (1.0 + shift_m) + Eigen::Vector2d(shift_m, shift_m);
      wall.to_in_world = wall.to_in_world * (1.0 + shift_m) + Eigen::Vector2d(shift_m, shift_m);
    }
    return scan_from(world, world_from_robot, 0.01, rng);
  };
  odometry.step(see(0.0), world_from_robot);
  world_from_robot = world_from_robot * Se2::exp({0.5, 0.0, 0.0});
  const MatchedStep carried_off = odometry.step(see(1.5), world_from_robot);
  EXPECT_NE(carried_off.status, MatchedStep::Status::Matched);
  EXPECT_THAT(carried_off.odom_from_robot, IsNear(world_from_robot, 1e-9));
  world_from_robot = world_from_robot * Se2::exp({0.3, 0.0, 0.1});
  const MatchedStep next = odometry.step(see(1.5), world_from_robot);
  EXPECT_EQ(next.status, MatchedStep::Status::Matched);
  EXPECT_THAT(next.odom_from_robot, IsNear(world_from_robot, 0.03));
}

TEST(MatchedOdometry, ForgetsWhatIsFarWhenTheWheelsJump) {
  Rng rng = make_rng(6);
  const Scan scan = scan_from(furnished_room(), Se2(), 0.01, rng);
  MatchedOdometry odometry;
  for (const double x_m : {0.0, 1e7, 0.0, -1e7}) {  // a map over all this would not fit anywhere
    const Se2 raw = Se2::from_xy_yaw(x_m, 0.0, 0.0);
    EXPECT_THAT(odometry.step(scan, raw).odom_from_robot, IsNear(raw, 1e-6));
  }
}

TEST(MatchedOdometry, GivesTheSameBytesTwice) {
  const auto run = [] {
    Rng rng = make_rng(7);
    MatchedOdometry odometry;
    Se2 world_from_robot;
    MatchedStep step;
    for (int i = 0; i < 10; ++i) {
      step =
          odometry.step(scan_from(furnished_room(), world_from_robot, 0.02, rng), world_from_robot);
      world_from_robot = world_from_robot * Se2::exp(kCurve);
    }
    return step;
  };
  const MatchedStep first = run();
  const MatchedStep second = run();
  EXPECT_EQ(first.odom_from_robot.x_m(), second.odom_from_robot.x_m());
  EXPECT_EQ(first.odom_from_robot.y_m(), second.odom_from_robot.y_m());
  EXPECT_EQ(first.odom_from_robot.yaw_rad(), second.odom_from_robot.yaw_rad());
  EXPECT_TRUE(first.covariance == second.covariance);
}

TEST(MatchedOdometry, RefusesParametersOutOfRange) {
  MatchedOdometryParams params;
  params.max_keyframes = 0;
  EXPECT_THROW(MatchedOdometry{params}, std::invalid_argument);
  params = {};
  params.wheels.floor_m = 0.0;
  EXPECT_THROW(MatchedOdometry{params}, std::invalid_argument);
  EXPECT_NO_THROW(validate(MatchedOdometryParams{}));
}

TEST(MatchedOdometryStatistical, CoversItsErrorsInARoom) {
  constexpr int kRuns = 30;
  constexpr int kSteps = 12;
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    Rng rng = make_rng(11, run);
    MatchedOdometry odometry;
    Se2 world_from_robot =
        Se2::from_xy_yaw(uniform(-1.0, 1.0, rng), uniform(-1.0, 1.0, rng), uniform(-3.0, 3.0, rng));
    Se2 raw;
    odometry.step(scan_from(furnished_room(), world_from_robot, 0.03, rng), raw);
    for (int i = 0; i < kSteps; ++i) {
      const Se2 motion = Se2::exp({0.1, 0.0, uniform(-0.4, 0.4, rng)});
      world_from_robot = world_from_robot * motion;
      raw = raw * sample_increment(motion, WheelPrior{}.noise, rng);
      const MatchedStep step =
          odometry.step(scan_from(furnished_room(), world_from_robot, 0.03, rng), raw);
      const Eigen::Vector3d error = (step.previous_from_robot.inverse() * motion).log();
      const double nees = error.dot(step.covariance.inverse() * error);
      sum += nees;
      squares += nees * nees;
    }
  }
  // Real surfaces are rougher than these walls, so the covariance is wide here: at most 3, the mean
  // of an honest one, and not wider than sevenfold.
  const double count = kRuns * kSteps;
  const double mean = sum / count;
  const double standard_error = std::sqrt((squares / count - mean * mean) / count);
  EXPECT_LT(mean, 3.0 + 5.0 * standard_error);
  EXPECT_GT(mean, 3.0 / 49.0);
}

}  // namespace
}  // namespace sketchloc

#include "motion/odometry.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/support/matchers.hpp"
#include "tests/support/moments.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

TEST(OdometryIncrement, LeadsFromOnePoseToTheNext) {
  const Se2 odom_from_robot = Se2::from_xy_yaw(3.0, -1.0, 2.0);
  const Se2 robot_from_next = Se2::from_xy_yaw(0.4, 0.1, -0.2);
  EXPECT_THAT(odometry_increment(odom_from_robot, odom_from_robot * robot_from_next),
              IsNear(robot_from_next, 1e-14));
}

TEST(IncrementSigma, IsZeroWhereNothingMoved) {
  EXPECT_EQ(increment_sigma(Se2(), {}), Eigen::Vector3d::Zero());
}

TEST(IncrementSigma, AddsWayAndTurnInQuadrature) {
  const OdometryNoise noise{
      .slip_m_per_m = 0.3, .slip_m_per_rad = 0.2, .turn_rad_per_m = 0.06, .turn_rad_per_rad = 0.04};
  const Se2 robot_from_next = Se2::from_xy_yaw(0.6, 0.8, -2.0);  // 1 m, 2 rad to the right
  const Eigen::Vector3d expected(0.5, 0.5, 0.1);                 // 3-4-5 and 6-8-10 triangles
  EXPECT_TRUE(increment_sigma(robot_from_next, noise).isApprox(expected, 1e-14));
}

TEST(SampleIncrement, RepeatsTheOdometryWithoutNoise) {
  const OdometryNoise none{
      .slip_m_per_m = 0.0, .slip_m_per_rad = 0.0, .turn_rad_per_m = 0.0, .turn_rad_per_rad = 0.0};
  const Se2 robot_from_next = Se2::from_xy_yaw(0.4, 0.1, -0.2);
  Rng rng = make_rng(1);
  EXPECT_THAT(sample_increment(robot_from_next, none, rng), IsNear(robot_from_next, 1e-15));
}

TEST(SampleIncrementStatistical, HasTheStatedMeanAndSpreadInItsTangentSpace) {
  const Se2 robot_from_next = Se2::from_xy_yaw(0.9, -0.3, 0.7);
  const OdometryNoise noise;
  constexpr std::size_t kDraws = 40'000;
  std::array<std::vector<double>, 3> errors;
  Rng rng = make_rng(2);
  for (std::size_t i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d error =
        (robot_from_next.inverse() * sample_increment(robot_from_next, noise, rng)).log();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      errors[axis].push_back(error[static_cast<Eigen::Index>(axis)]);
    }
  }
  const Eigen::Vector3d sigma = increment_sigma(robot_from_next, noise);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const testing::SampleMoments found = testing::sample_moments(errors[axis]);
    const double variance = std::pow(sigma[static_cast<Eigen::Index>(axis)], 2);
    EXPECT_NEAR(found.mean, 0.0, 5.0 * found.mean_error) << axis;
    EXPECT_NEAR(found.variance, variance, 5.0 * found.variance_error) << axis;
  }
}

TEST(OdometryNoise, IsValidByDefaultAndAtItsLimits) {
  EXPECT_NO_THROW(validate(OdometryNoise{}));
  EXPECT_NO_THROW(validate(OdometryNoise{
      .slip_m_per_m = 1.0, .slip_m_per_rad = 0.0, .turn_rad_per_m = 0.0, .turn_rad_per_rad = 0.0}));
}

TEST(OdometryNoise, IsRefusedOutsideItsRanges) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(validate(OdometryNoise{.slip_m_per_m = 1.01}), std::invalid_argument);
  EXPECT_THROW(validate(OdometryNoise{.slip_m_per_rad = -0.1}), std::invalid_argument);
  EXPECT_THROW(validate(OdometryNoise{.turn_rad_per_m = kNan}), std::invalid_argument);
  EXPECT_THROW(validate(OdometryNoise{.turn_rad_per_rad = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "motion/sim2.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <tuple>

#include "tests/support/matchers.hpp"
#include "tests/support/matrix_exponential.hpp"
#include "tests/support/numeric_jacobian.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;
constexpr double kPi = std::numbers::pi;

/// Laws over yaw and log scale: zero, both sides of the series switch, close to pi, real drawings.
class Sim2Laws : public ::testing::TestWithParam<std::tuple<double, double>> {
 protected:
  const double yaw_rad_ = std::get<0>(GetParam());
  const double log_scale_ = std::get<1>(GetParam());
  const Eigen::Vector4d twist_{1.5, -0.5, yaw_rad_, log_scale_};
  const Sim2 pose_ = Sim2::from_xy_yaw_scale(2.0, -1.0, yaw_rad_, std::exp(log_scale_));
  const Sim2 second_ = Sim2::from_xy_yaw_scale(-0.4, 3.0, 2.0, 0.5);
  const Sim2 third_ = Sim2::from_xy_yaw_scale(7.0, 0.1, -0.3, 3.0);
};

using YawAndLogScale = std::tuple<double, double>;
INSTANTIATE_TEST_SUITE_P(
    YawsAndScales, Sim2Laws,
    ::testing::Values(YawAndLogScale{0.0, 0.0}, YawAndLogScale{1e-12, -1e-12},
                      YawAndLogScale{-0.00999, 0.0}, YawAndLogScale{0.01001, 0.0},
                      YawAndLogScale{0.0, 0.00999}, YawAndLogScale{0.0, -0.01001},
                      YawAndLogScale{0.007, 0.0072}, YawAndLogScale{-1.0, -1.0},
                      YawAndLogScale{kPi - 1e-9, 0.0}, YawAndLogScale{-kPi + 1e-9, 0.01},
                      YawAndLogScale{kPi, std::log(20.7)}, YawAndLogScale{2.0, std::log(20.7)}));

TEST_P(Sim2Laws, LogUndoesExp) {
  EXPECT_TRUE(Sim2::exp(twist_).log().isApprox(twist_, 1e-12)) << Sim2::exp(twist_).log();
}

TEST_P(Sim2Laws, ExpUndoesLog) { EXPECT_THAT(Sim2::exp(pose_.log()), IsNear(pose_, 1e-12)); }

TEST_P(Sim2Laws, ExpIsTheMatrixExponential) {
  Eigen::Matrix3d generator = Eigen::Matrix3d::Zero();
  generator.topLeftCorner<2, 2>() << log_scale_, -yaw_rad_, yaw_rad_, log_scale_;
  generator.topRightCorner<2, 1>() = twist_.head<2>();
  const Eigen::Matrix3d expected = testing::matrix_exponential(generator);
  const Sim2 pose = Sim2::exp(twist_);
  EXPECT_TRUE(pose.scaled_rotation_matrix().isApprox(expected.topLeftCorner<2, 2>(), 1e-13));
  EXPECT_TRUE(pose.translation().isApprox(expected.topRightCorner<2, 1>(), 1e-13));
}

TEST_P(Sim2Laws, CompositionIsAssociative) {
  EXPECT_THAT((pose_ * second_) * third_, IsNear(pose_ * (second_ * third_), 1e-12));
}

TEST_P(Sim2Laws, CompositionAppliesTheRightOneFirst) {
  const Eigen::Vector2d point(0.3, -4.0);
  EXPECT_TRUE(((second_ * pose_) * point).isApprox(second_ * (pose_ * point), 1e-13));
}

TEST_P(Sim2Laws, InverseUndoesTheSimilarityOnBothSides) {
  EXPECT_THAT(pose_.inverse() * pose_, IsNear(Sim2(), 1e-14));
  EXPECT_THAT(pose_ * pose_.inverse(), IsNear(Sim2(), 1e-14));
}

TEST_P(Sim2Laws, MatrixAndOperatorAgree) {
  const Eigen::Vector2d point(0.3, -4.0);
  const Eigen::Vector2d expected = pose_.scaled_rotation_matrix() * point + pose_.translation();
  EXPECT_TRUE((pose_ * point).isApprox(expected, 1e-14));
  EXPECT_NEAR(pose_.scaled_rotation_matrix().determinant(), std::exp(2.0 * log_scale_),
              1e-12 * std::exp(2.0 * log_scale_));
}

TEST_P(Sim2Laws, AdjointMovesATwistAcross) {
  const Eigen::Vector4d twist(0.03, 0.02, -0.7, 0.2);
  EXPECT_THAT(pose_ * Sim2::exp(twist) * pose_.inverse(),
              IsNear(Sim2::exp(pose_.adjoint() * twist), 1e-12));
}

TEST_P(Sim2Laws, AdjointIsTheDerivativeOfConjugation) {
  const auto conjugate = [this](const Eigen::Vector4d& twist) -> Eigen::Vector4d {
    return (pose_ * Sim2::exp(twist) * pose_.inverse()).log();
  };
  const Eigen::Matrix4d numeric =
      testing::numeric_jacobian(conjugate, Eigen::Vector4d{Eigen::Vector4d::Zero()});
  EXPECT_TRUE(pose_.adjoint().isApprox(numeric, 1e-8)) << numeric;
}

TEST_P(Sim2Laws, InterpolationStartsAndEndsAtItsPosesAndMovesEvenly) {
  const Sim2 end = second_ * Sim2::exp(twist_);
  EXPECT_THAT(interpolate(second_, end, 0.0), IsNear(second_, 1e-14));
  EXPECT_THAT(interpolate(second_, end, 1.0), IsNear(end, 1e-12));
  const Sim2 quarter = interpolate(second_, end, 0.25);
  EXPECT_THAT(quarter, IsNear(second_ * Sim2::exp(0.25 * twist_), 1e-12));
}

TEST_P(Sim2Laws, YawStaysInItsHalfOpenRange) {
  for (const Sim2& pose : {pose_, pose_.inverse(), Sim2::exp(-twist_), pose_ * pose_}) {
    EXPECT_GT(pose.yaw_rad(), -kPi);
    EXPECT_LE(pose.yaw_rad(), kPi);
    EXPECT_GT(pose.log()[2], -kPi);
  }
}

TEST_P(Sim2Laws, RigidMotionsAreSimilaritiesOfScaleOne) {
  const Se2 first = Se2::from_xy_yaw(1.0, 2.0, yaw_rad_);
  const Se2 second = Se2::from_xy_yaw(-3.0, 0.5, 1.0);
  EXPECT_THAT(Sim2::from_se2(first) * Sim2::from_se2(second),
              IsNear(Sim2::from_se2(first * second), 1e-13));
  EXPECT_THAT(pose_ * second, IsNear(pose_ * Sim2::from_se2(second), 1e-14));
  const Eigen::Vector4d twist(0.3, -0.1, yaw_rad_, 0.0);
  EXPECT_THAT(Sim2::exp(twist), IsNear(Sim2::from_se2(Se2::exp(twist.head<3>())), 1e-14));
}

TEST(Sim2, IsTheIdentityByDefault) {
  const Eigen::Vector2d point(3.0, -2.0);
  EXPECT_EQ(Sim2() * point, point);
  EXPECT_EQ(Sim2().log(), Eigen::Vector4d::Zero());
}

TEST(Sim2, GivesBackWhatItWasMadeFrom) {
  const Sim2 pose = Sim2::from_xy_yaw_scale(310.5, 42.0, -2.9, 20.7);
  EXPECT_EQ(pose.x(), 310.5);
  EXPECT_EQ(pose.y(), 42.0);
  EXPECT_NEAR(pose.yaw_rad(), -2.9, 1e-15);
  EXPECT_NEAR(pose.scale(), 20.7, 1e-14);
}

TEST(Sim2, TurnsMetresIntoPixels) {
  const Sim2 sketch_from_robot = Sim2::from_xy_yaw_scale(100.0, 50.0, kPi / 2.0, 20.0);
  const Eigen::Vector2d ahead_in_sketch = sketch_from_robot * Eigen::Vector2d(3.0, 0.0);
  EXPECT_TRUE(ahead_in_sketch.isApprox(Eigen::Vector2d(100.0, 110.0), 1e-14));
}

TEST(Sim2DeathTest, RefusesAScaleThatIsNotPositive) {
  EXPECT_DEATH(Sim2::from_xy_yaw_scale(0.0, 0.0, 0.0, 0.0), "scale of a Sim2 must be positive");
  EXPECT_DEATH(Sim2::from_xy_yaw_scale(0.0, 0.0, 0.0, std::nan("")), "must be positive");
}

}  // namespace
}  // namespace sketchloc

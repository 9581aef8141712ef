#include "motion/se2.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "tests/support/matchers.hpp"
#include "tests/support/matrix_exponential.hpp"
#include "tests/support/numeric_jacobian.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;
constexpr double kPi = std::numbers::pi;

/// Laws over the yaws that break things: zero, both sides of the series switch, close to pi.
class Se2Laws : public ::testing::TestWithParam<double> {
 protected:
  const Eigen::Vector3d twist_{1.5, -0.5, GetParam()};
  const Se2 pose_ = Se2::from_xy_yaw(2.0, -1.0, GetParam());
  const Se2 second_ = Se2::from_xy_yaw(-0.4, 3.0, 2.0);
  const Se2 third_ = Se2::from_xy_yaw(7.0, 0.1, -0.3);
};

INSTANTIATE_TEST_SUITE_P(Yaws, Se2Laws,
                         ::testing::Values(0.0, 1e-12, -1e-12, 0.00999, 0.01001, -0.01, 1.0, -2.0,
                                           kPi - 1e-9, -kPi + 1e-9, kPi));

TEST_P(Se2Laws, LogUndoesExp) {
  EXPECT_TRUE(Se2::exp(twist_).log().isApprox(twist_, 1e-12)) << Se2::exp(twist_).log();
}

TEST_P(Se2Laws, ExpUndoesLog) { EXPECT_THAT(Se2::exp(pose_.log()), IsNear(pose_, 1e-12)); }

TEST_P(Se2Laws, ExpIsTheMatrixExponential) {
  Eigen::Matrix3d generator = Eigen::Matrix3d::Zero();
  generator.topLeftCorner<2, 2>() << 0.0, -twist_.z(), twist_.z(), 0.0;
  generator.topRightCorner<2, 1>() = twist_.head<2>();
  const Eigen::Matrix3d expected = testing::matrix_exponential(generator);
  EXPECT_TRUE(Se2::exp(twist_).rotation_matrix().isApprox(expected.topLeftCorner<2, 2>(), 1e-13));
  EXPECT_TRUE(Se2::exp(twist_).translation().isApprox(expected.topRightCorner<2, 1>(), 1e-13));
}

TEST_P(Se2Laws, CompositionIsAssociative) {
  EXPECT_THAT((pose_ * second_) * third_, IsNear(pose_ * (second_ * third_), 1e-13));
}

TEST_P(Se2Laws, CompositionAppliesTheRightOneFirst) {
  const Eigen::Vector2d point(0.3, -4.0);
  EXPECT_TRUE(((second_ * pose_) * point).isApprox(second_ * (pose_ * point), 1e-13));
}

TEST_P(Se2Laws, InverseUndoesTheMotionOnBothSides) {
  EXPECT_THAT(pose_.inverse() * pose_, IsNear(Se2(), 1e-14));
  EXPECT_THAT(pose_ * pose_.inverse(), IsNear(Se2(), 1e-14));
}

TEST_P(Se2Laws, MatrixAndOperatorAgree) {
  const Eigen::Vector2d point(0.3, -4.0);
  const Eigen::Vector2d expected = pose_.rotation_matrix() * point + pose_.translation();
  EXPECT_TRUE((pose_ * point).isApprox(expected, 1e-14));
  EXPECT_NEAR(pose_.rotation_matrix().determinant(), 1.0, 1e-14);
}

TEST_P(Se2Laws, AdjointMovesATwistAcross) {
  const Eigen::Vector3d twist(0.3, 0.2, -0.7);
  EXPECT_THAT(pose_ * Se2::exp(twist) * pose_.inverse(),
              IsNear(Se2::exp(pose_.adjoint() * twist), 1e-12));
}

TEST_P(Se2Laws, AdjointIsTheDerivativeOfConjugation) {
  const auto conjugate = [this](const Eigen::Vector3d& twist) -> Eigen::Vector3d {
    return (pose_ * Se2::exp(twist) * pose_.inverse()).log();
  };
  const Eigen::Matrix3d numeric =
      testing::numeric_jacobian(conjugate, Eigen::Vector3d{Eigen::Vector3d::Zero()});
  EXPECT_TRUE(pose_.adjoint().isApprox(numeric, 1e-9)) << numeric;
}

TEST_P(Se2Laws, InterpolationStartsAndEndsAtItsPosesAndMovesEvenly) {
  const Se2 end = second_ * Se2::exp(twist_);
  EXPECT_THAT(interpolate(second_, end, 0.0), IsNear(second_, 1e-14));
  EXPECT_THAT(interpolate(second_, end, 1.0), IsNear(end, 1e-12));
  const Se2 quarter = interpolate(second_, end, 0.25);
  EXPECT_THAT(quarter, IsNear(second_ * Se2::exp(0.25 * twist_), 1e-12));
}

TEST_P(Se2Laws, YawStaysInItsHalfOpenRange) {
  for (const Se2& pose : {pose_, pose_.inverse(), Se2::exp(-twist_), pose_ * pose_}) {
    EXPECT_GT(pose.yaw_rad(), -kPi);
    EXPECT_LE(pose.yaw_rad(), kPi);
  }
}

TEST(Se2, IsTheIdentityByDefault) {
  const Eigen::Vector2d point(3.0, -2.0);
  EXPECT_EQ(Se2() * point, point);
  EXPECT_EQ(Se2().log(), Eigen::Vector3d::Zero());
}

TEST(Se2, GivesBackWhatItWasMadeFrom) {
  const Se2 pose = Se2::from_xy_yaw(2.0, -1.0, 0.7);
  EXPECT_EQ(pose.x_m(), 2.0);
  EXPECT_EQ(pose.y_m(), -1.0);
  EXPECT_NEAR(pose.yaw_rad(), 0.7, 1e-15);
}

TEST(Se2, TurnsByMinusPiAreTurnsByPi) {
  EXPECT_EQ(Se2::from_xy_yaw(0.0, 0.0, -kPi).yaw_rad(), kPi);
  EXPECT_EQ(Se2::from_xy_yaw(0.0, 0.0, kPi).inverse().yaw_rad(), kPi);
  EXPECT_EQ(Se2::from_xy_yaw(0.0, 0.0, -kPi).log().z(), kPi);
}

TEST(Se2, StaysRigidThroughAMillionCompositions) {
  const Se2 step = Se2::exp({0.01, 0.0, 0.001});
  Se2 pose;
  for (int i = 0; i < 1'000'000; ++i) {
    pose = pose * step;
  }
  EXPECT_NEAR(pose.rotation_matrix().determinant(), 1.0, 1e-15);
}

TEST(Se2, DrivesAQuarterCircleAtConstantTwist) {
  const Se2 pose = Se2::exp({kPi / 2.0, 0.0, kPi / 2.0});  // radius 1 m, to the left
  EXPECT_THAT(pose, IsNear(Se2::from_xy_yaw(1.0, 1.0, kPi / 2.0), 1e-15));
}

}  // namespace
}  // namespace sketchloc

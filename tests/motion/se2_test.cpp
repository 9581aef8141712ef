#include "motion/se2.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

class Se2Laws : public ::testing::TestWithParam<double> {};

TEST_P(Se2Laws, LogUndoesExp) {
  const Eigen::Vector3d twist(1.5, -0.5, GetParam());
  EXPECT_TRUE(Se2::exp(twist).log().isApprox(twist, 1e-12));
}

TEST_P(Se2Laws, AdjointMovesATwistAcross) {
  const Se2 pose = Se2::from_xy_yaw(2.0, -1.0, GetParam());
  const Eigen::Vector3d twist(0.3, 0.2, -0.7);
  EXPECT_THAT(pose * Se2::exp(twist) * pose.inverse(),
              IsNear(Se2::exp(pose.adjoint() * twist), 1e-12));
}

INSTANTIATE_TEST_SUITE_P(Yaws, Se2Laws,
                         ::testing::Values(0.0, 1e-12, 0.00999, 0.01001, 1.0, -2.0,
                                           std::numbers::pi - 1e-9, -std::numbers::pi + 1e-9));

TEST(Se2, InverseUndoesTheMotion) {
  const Se2 pose = Se2::from_xy_yaw(2.0, -1.0, 0.7);
  EXPECT_THAT(pose.inverse() * pose, IsNear(Se2(), 1e-14));
}

}  // namespace
}  // namespace sketchloc

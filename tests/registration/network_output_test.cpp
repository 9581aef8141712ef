#include "registration/network_output.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "registration/network_input.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

const LocalWindow kWindow{.side_m = 16.0, .cells = 64};

TEST(ResidualOutput, PoseIsTakenInTheFrameOfThePrior) {
  const Sim2 prior = Sim2::from_xy_yaw_scale(100.0, 80.0, 0.7, 15.0);
  const Sim2 truth = Sim2::from_xy_yaw_scale(112.0, 71.0, 0.4, 18.0);
  const Sim2 prior_from_robot = prior.inverse() * truth;
  std::vector<float> output(ResidualOutput::kSize);
  output[ResidualOutput::kPose] = static_cast<float>(prior_from_robot.x());
  output[ResidualOutput::kPose + 1] = static_cast<float>(prior_from_robot.y());
  output[ResidualOutput::kPose + 2] = static_cast<float>(prior_from_robot.yaw_rad());
  output[ResidualOutput::kPose + 3] = static_cast<float>(std::log(prior_from_robot.scale()));
  EXPECT_THAT(pose_of_residual(output, prior, kWindow), IsNear(truth, 1e-4));
}

TEST(ResidualOutput, MeansLengthsByTheSizeOfTheWindow) {
  const LocalWindow half{.side_m = 0.5 * kWindow.side_m, .cells = kWindow.cells};
  std::vector<float> output(ResidualOutput::kSize);
  output[ResidualOutput::kPose] = 1.0F;
  for (std::size_t i = 0; i < 2 * kControls; i += 2) {
    output[i] = 1.0F;  // the same shift in x for all control points
  }
  const Sim2 prior;
  EXPECT_NEAR(pose_of_residual(output, prior, kWindow).x(), 1.0, 1e-9);
  EXPECT_NEAR(pose_of_residual(output, prior, half).x(), 0.5, 1e-9);
  EXPECT_NEAR(warp_of_residual(output, prior, half).pose()->x(), 0.5, 1e-6);
  const Eigen::Matrix4d wide = covariance_of_residual(output, kWindow);
  const Eigen::Matrix4d narrow = covariance_of_residual(output, half);
  EXPECT_NEAR(narrow(0, 0), 0.25 * wide(0, 0), 1e-9);
  EXPECT_NEAR(narrow(2, 2), wide(2, 2), 1e-9);
}

TEST(ResidualOutput, WhiteningIsTriangularWithAPositiveDiagonal) {
  std::vector<float> output(ResidualOutput::kSize);
  for (int i = 0; i < 10; ++i) {
    output[static_cast<std::size_t>(ResidualOutput::kWhitening + i)] = static_cast<float>(i - 5);
  }
  const Eigen::Matrix4d whitening = whitening_of_residual(output);
  EXPECT_NEAR(whitening(0, 0), std::exp(ResidualOutput::kMinLogPrecision), 1e-9);  // limited
  EXPECT_NEAR(whitening(3, 3), std::exp(-2.0), 1e-9);
  EXPECT_EQ(whitening(1, 0), -1.0);
  EXPECT_EQ(whitening(2, 0), 0.0);
  EXPECT_EQ(whitening(3, 2), 4.0);
  EXPECT_EQ(whitening(0, 3), 0.0);
}

/// The affine numbers of a rigid, scaled drawing: source = A target + b.
std::vector<float> affine_of(const Sim2& sketch_from_robot, const Eigen::Vector2d& crop_centre) {
  const Sim2 robot_from_sketch = sketch_from_robot.inverse();
  const double half_px = 0.5 * published_crop_side_px(kWindow);
  const double per_half_m = 2.0 / kWindow.side_m;
  const Eigen::Matrix2d linear = per_half_m * half_px * robot_from_sketch.scaled_rotation_matrix();
  const Eigen::Vector2d shift = per_half_m * (robot_from_sketch * crop_centre);
  return {static_cast<float>(linear(0, 0)), static_cast<float>(linear(0, 1)),
          static_cast<float>(shift.x()),    static_cast<float>(linear(1, 0)),
          static_cast<float>(linear(1, 1)), static_cast<float>(shift.y())};
}

TEST(PublishedOutput, GivesThePoseOfAKnownWarp) {
  const Eigen::Vector2d crop_centre(200.0, 150.0);
  const Sim2 truth = Sim2::from_xy_yaw_scale(215.0, 139.0, 2.1, 17.0);
  const std::optional<Sim2> pose =
      pose_of_published(sources_of_affine(affine_of(truth, crop_centre)), crop_centre, kWindow);
  ASSERT_TRUE(pose.has_value());
  EXPECT_THAT(*pose, IsNear(truth, 1e-3));
}

TEST(PublishedOutput, GivesNoPoseWhereTheWarpMirrors) {
  std::vector<float> mirrored = affine_of(Sim2::from_xy_yaw_scale(0.0, 0.0, 0.0, 20.0), {0.0, 0.0});
  mirrored[0] = -mirrored[0];
  EXPECT_FALSE(pose_of_published(sources_of_affine(mirrored), {0.0, 0.0}, kWindow).has_value());
}

TEST(PublishedOutput, GivesNoPoseWhereEverythingFallsOntoOnePoint) {
  const std::vector<float> collapsed(PublishedOutput::kSplineSize, 0.5F);
  EXPECT_FALSE(pose_of_published(collapsed, {0.0, 0.0}, kWindow).has_value());
}

}  // namespace
}  // namespace sketchloc

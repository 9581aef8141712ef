#include "registration/train/detail/losses.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <span>
#include <vector>

#include "registration/network_output.hpp"

namespace sketchloc {
namespace {

using detail::ResidualLoss;
using detail::ResidualTruth;

ResidualTruth truth_of(const torch::Tensor& pose, std::int64_t points) {
  return {.grid_shift = torch::zeros({pose.size(0), points, 2}),
          .grid_weight = torch::ones({pose.size(0), points}),
          .pose = pose,
          .unit_m = torch::ones({pose.size(0)})};
}

TEST(ResidualLoss, VanishesAtTheTruth) {
  const torch::Tensor spline = torch::eye(kControls);
  const torch::Tensor output = torch::zeros({2, ResidualOutput::kSize});
  const ResidualLoss loss =
      detail::residual_loss(output, truth_of(torch::zeros({2, 4}), kControls), spline);
  EXPECT_NEAR(loss.grid.item<double>(), 0.0, 1e-6);
  EXPECT_NEAR(loss.pose.item<double>(), 0.0, 1e-6);
}

TEST(ResidualLoss, CountsOnlyGridPointsWithWeight) {
  const torch::Tensor spline = torch::eye(kControls);
  ResidualTruth truth = truth_of(torch::zeros({1, 4}), kControls);
  truth.grid_shift[0][3][0] = 10.0;
  truth.grid_weight[0][3] = 0.0;
  const torch::Tensor output = torch::zeros({1, ResidualOutput::kSize});
  EXPECT_NEAR(detail::residual_loss(output, truth, spline).grid.item<double>(), 0.0, 1e-6);
}

TEST(ResidualLoss, SpreadIsTheLikelihoodOfTheWhitening) {
  torch::manual_seed(4);
  const torch::Tensor output = 0.3 * torch::randn({1, ResidualOutput::kSize});
  const torch::Tensor pose = 0.5 * torch::randn({1, 4});
  const ResidualLoss loss =
      detail::residual_loss(output, truth_of(pose, kControls), torch::eye(kControls));
  const std::vector<float> numbers(output.data_ptr<float>(),
                                   output.data_ptr<float>() + output.numel());
  const Eigen::Matrix4d whitening = whitening_of_residual(numbers);
  Eigen::Vector4d error;
  for (int i = 0; i < 4; ++i) {
    error(i) =
        pose[0][i].item<double>() - numbers[static_cast<std::size_t>(ResidualOutput::kPose + i)];
  }
  // Student's t with 4 degrees of freedom; its scale matrix is half of its covariance.
  const double expected =
      4.0 * std::log1p((whitening * error).squaredNorm() / 2.0) - std::log(whitening.determinant());
  EXPECT_NEAR(loss.spread.item<double>(), expected, 1e-4);
}

TEST(ResidualLoss, SpreadMovesTheWhiteningOnly) {
  torch::Tensor output = torch::zeros({1, ResidualOutput::kSize});
  output.set_requires_grad(true);
  const ResidualTruth truth = truth_of(2.0 * torch::ones({1, 4}), kControls);
  detail::residual_loss(output, truth, torch::eye(kControls)).spread.backward();
  for (std::int64_t i = 0; i < ResidualOutput::kSize; ++i) {
    const bool whitening = i >= ResidualOutput::kWhitening && i < ResidualOutput::kWhitening + 10;
    EXPECT_EQ(output.grad()[0][i].item<double>() != 0.0, whitening) << i;
  }
}

TEST(ResidualLoss, TellsRightFromWrongInMetres) {
  // 0.6 units off: wrong in units of a metre, right in those of half a metre.
  torch::Tensor output = torch::zeros({1, ResidualOutput::kSize});
  output[0][ResidualOutput::kInlierLogit] = 5.0;
  torch::Tensor pose = torch::zeros({1, 4});
  pose[0][0] = 0.6;
  ResidualTruth truth = truth_of(pose, kControls);
  const double in_metres =
      detail::residual_loss(output, truth, torch::eye(kControls)).inlier.item<double>();
  truth.unit_m = 0.5 * truth.unit_m;
  const double in_halves =
      detail::residual_loss(output, truth, torch::eye(kControls)).inlier.item<double>();
  EXPECT_GT(in_metres, 4.9);
  EXPECT_LT(in_halves, 0.1);
}

TEST(AffineSources, AgreeWithTheOnesUsedAfterTraining) {
  const std::vector<float> numbers = {0.9F, 0.1F, -0.2F, -0.15F, 1.1F, 0.3F};
  const torch::Tensor sources = detail::affine_sources(torch::tensor(numbers).view({1, 6}));
  const auto expected = sources_of_affine(numbers);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(sources[0][static_cast<std::int64_t>(i)].item<double>(), expected[i], 1e-6);
  }
}

}  // namespace
}  // namespace sketchloc

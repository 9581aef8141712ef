#include "registration/train/detail/losses.hpp"

#include <vector>

#include "registration/control_grid.hpp"
#include "registration/network_output.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc::detail {
namespace {

using torch::indexing::Slice;

constexpr double kGridKnee = 0.25;  ///< units; errors below count squared, above by their length
constexpr double kPoseKnee = 0.1;
constexpr double kLever = 2.0;  ///< a radian and a unit of log scale count as so many units
constexpr double kInlier_m = 0.5;
constexpr double kInlier_rad = 0.26;

torch::Tensor columns(const torch::Tensor& output, int first, int count) {
  return output.index({Slice(), Slice(first, first + count)});
}

/// sqrt(squared + knee^2) - knee
torch::Tensor robust(const torch::Tensor& squared, double knee) {
  return torch::sqrt(squared + knee * knee) - knee;
}

torch::Tensor grid_loss(const torch::Tensor& output, const ResidualTruth& truth,
                        const torch::Tensor& spline) {
  const torch::Tensor controls =
      columns(output, ResidualOutput::kControlShift, 2 * kControls).reshape({-1, kControls, 2});
  const torch::Tensor error = torch::matmul(spline, controls) - truth.grid_shift;
  const torch::Tensor weighted = truth.grid_weight * robust(error.square().sum(2), kGridKnee);
  return weighted.sum() / truth.grid_weight.sum().clamp_min(1.0);
}

/// Minus the log likelihood of Student's t, but for a constant, with W from the ten numbers of
/// ResidualOutput::kWhitening: (d + 4) / 2 log(1 + |W (truth - mean)|^2 / (d - 2)) - log det W,
/// d its degrees of freedom and (W^T W)^-1 its covariance.
torch::Tensor spread_loss(const torch::Tensor& output, const torch::Tensor& error) {
  const torch::Tensor numbers = columns(output, ResidualOutput::kWhitening, 10);
  const torch::Tensor log_diagonal =
      columns(numbers, 0, 4)
          .clamp(ResidualOutput::kMinLogPrecision, ResidualOutput::kMaxLogPrecision);
  const torch::Tensor diagonal = torch::exp(log_diagonal);
  std::vector<torch::Tensor> whitened;
  std::int64_t next = 4;
  for (std::int64_t row = 0; row < 4; ++row) {
    torch::Tensor sum = diagonal.select(1, row) * error.select(1, row);
    for (std::int64_t column = 0; column < row; ++column) {
      sum = sum + numbers.select(1, next++) * error.select(1, column);
    }
    whitened.push_back(sum);
  }
  const torch::Tensor squared = torch::stack(whitened, 1).square().sum(1);
  const torch::Tensor far = torch::log1p(squared / (kErrorDegrees - 2.0));
  return (0.5 * (kErrorDegrees + 4.0) * far - log_diagonal.sum(1)).mean();
}

torch::Tensor inlier_loss(const torch::Tensor& output, const torch::Tensor& error,
                          const torch::Tensor& unit_m) {
  const torch::Tensor right = torch::logical_and(
      columns(error, 0, 2).square().sum(1) * unit_m.square() < kInlier_m * kInlier_m,
      error.select(1, 2).abs() < kInlier_rad);
  return torch::binary_cross_entropy_with_logits(output.select(1, ResidualOutput::kInlierLogit),
                                                 right.to(torch::kFloat32));
}

}  // namespace

ResidualLoss residual_loss(const torch::Tensor& output, const ResidualTruth& truth,
                           const torch::Tensor& spline) {
  const torch::Tensor error = truth.pose - columns(output, ResidualOutput::kPose, 4);
  const torch::Tensor settled = error.detach();
  const torch::Tensor position = robust(columns(error, 0, 2).square().sum(1), kPoseKnee);
  const torch::Tensor rest = robust((kLever * columns(error, 2, 2)).square(), kPoseKnee).sum(1);
  return {.grid = grid_loss(output, truth, spline),
          .pose = (position + rest).mean(),
          .spread = spread_loss(output, settled),
          .inlier = inlier_loss(output, settled, truth.unit_m)};
}

torch::Tensor published_loss(const torch::Tensor& sources, const torch::Tensor& true_sources) {
  return torch::mse_loss(sources, true_sources);
}

torch::Tensor affine_sources(const torch::Tensor& output) {
  torch::Tensor targets = torch::ones({kControls, 3});
  const std::vector<Eigen::Vector2d> controls =
      square_lattice(kControlsPerSide, 2.0, Eigen::Vector2d::Zero());
  for (std::int64_t i = 0; i < kControls; ++i) {
    targets[i][0] = controls[static_cast<std::size_t>(i)].x();
    targets[i][1] = controls[static_cast<std::size_t>(i)].y();
  }
  // (count, 2, 3) x (3, points) -> (count, 2, points) -> x, y, x, y ...
  const torch::Tensor sources = torch::matmul(output.reshape({-1, 2, 3}), targets.t());
  return sources.transpose(1, 2).reshape({-1, 2 * kControls});
}

}  // namespace sketchloc::detail

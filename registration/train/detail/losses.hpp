#pragma once

#include <torch/torch.h>

#include "registration/local_window.hpp"

namespace sketchloc::detail {

/// What a residual network is judged by; all tensors have one row per sample.
struct ResidualTruth {
  torch::Tensor grid_shift;   ///< points x 2
  torch::Tensor grid_weight;  ///< points
  torch::Tensor pose;         ///< 4
  torch::Tensor unit_m;       ///< what lengths are in
};

struct ResidualLoss {
  torch::Tensor grid;  ///< robust distance of warped grid points, in units
  torch::Tensor pose;  ///< robust distance of position, heading and scale, in units at a lever of 2
  torch::Tensor spread;  ///< negative log likelihood of the pose, which moves the whitening only
  torch::Tensor inlier;  ///< cross entropy of "this pose is right"

  torch::Tensor total() const { return grid + pose + 0.05 * spread + 0.1 * inlier; }
};

/// `spline`: grid points x control points, see spline_matrix.
ResidualLoss residual_loss(const torch::Tensor& output, const ResidualTruth& truth,
                           const torch::Tensor& spline);

/// [Chen20]: mean squared error of the sources of the control points.
torch::Tensor published_loss(const torch::Tensor& sources, const torch::Tensor& true_sources);

/// The sources of an affine output, see PublishedOutput.
torch::Tensor affine_sources(const torch::Tensor& output);

}  // namespace sketchloc::detail

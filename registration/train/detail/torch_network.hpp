#pragma once

#include <torch/torch.h>

#include <vector>

#include "registration/train/network_plan.hpp"

namespace sketchloc::detail {

/// Convolution or fully connected layer with its batch normalisation; that is nullptr, and the
/// layer has a bias, in a network that goes on from one where it is folded in.
struct NormalisedConvolution {
  ConvolutionPlan plan;
  torch::nn::Conv2d convolution;
  torch::nn::BatchNorm2d norm{nullptr};
};
struct NormalisedLinear {
  LinearPlan plan;
  torch::nn::Linear linear;
  torch::nn::BatchNorm1d norm{nullptr};  ///< of hidden layers only
};
struct NormalisedResidual {
  NormalisedConvolution first;
  NormalisedConvolution second;
};

struct NormalisedEncoder {
  NormalisedConvolution first;
  NormalisedConvolution second;
  NormalisedResidual third;
};
struct NormalisedMatch {
  MatchPlan plan;
  NormalisedEncoder scan;
  NormalisedEncoder drawing;
};

/// A planned network that can learn.
class TorchNetwork : public torch::nn::Module {
 public:
  /// With random numbers, to be drawn from torch's generator.
  explicit TorchNetwork(const NetworkPlan& plan) : TorchNetwork(plan, true) {}
  /// With the numbers of a trained one, and without batch normalisation.
  explicit TorchNetwork(const FoldedNetwork& folded);

  /// count x channels x cells x cells to count x outputs.
  torch::Tensor forward(torch::Tensor values);

  /// For use, not for learning: what export writes.
  FoldedNetwork fold() const;

  /// Moves all numbers, those of batch normalisation too, a share of the way to another's.
  void follow(const TorchNetwork& other, double share);

 private:
  TorchNetwork(const NetworkPlan& plan, bool normalise);

  NormalisedConvolution make(const ConvolutionPlan& plan);
  NormalisedResidual make(const ResidualPlan& plan);
  NormalisedMatch make(const MatchPlan& plan);
  NormalisedLinear make(const LinearPlan& plan);
  NormalisedEncoder make_encoder(int inputs, const MatchPlan& plan);

  NetworkPlan plan_;
  bool normalise_;
  std::vector<
      std::variant<NormalisedConvolution, NormalisedResidual, NormalisedMatch, NormalisedLinear>>
      layers_;
  int registered_ = 0;
};

}  // namespace sketchloc::detail

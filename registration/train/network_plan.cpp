#include "registration/train/network_plan.hpp"

#include <cstddef>
#include <utility>

#include "motion/check.hpp"
#include "registration/network_output.hpp"
#include "registration/verified_predictor.hpp"

namespace sketchloc {
namespace {

/// The paper does not give the widths; these learn at a bearable speed on a processor.
NetworkPlan published_plan(int cells, int outputs) {
  const int left = cells / 32;
  return {.channels = channels_of(InputKind::Published),
          .cells = cells,
          .outputs = outputs,
          .layers = {ConvolutionPlan{channels_of(InputKind::Published), 16, 2},
                     ConvolutionPlan{16, 32, 2}, ConvolutionPlan{32, 64, 2},
                     ConvolutionPlan{64, 64, 2}, ConvolutionPlan{64, 128, 2},
                     ConvolutionPlan{128, 128, 1}, ConvolutionPlan{128, 128, 1},
                     LinearPlan{128 * left * left, 256, true}, LinearPlan{256, outputs, false}}};
}

NetworkPlan matching_plan(int cells, int outputs) {
  const int left = cells / 16;
  const MatchPlan match{.scan_channels = 2, .drawing_channels = 3};
  return {.channels = channels_of(InputKind::Residual),
          .cells = cells,
          .outputs = outputs,
          .layers = {match, ConvolutionPlan{match.outputs(), 64, 2}, ResidualPlan{64},
                     ConvolutionPlan{64, 128, 2}, ResidualPlan{128},
                     LinearPlan{128 * left * left, 256, true}, LinearPlan{256, outputs, false}}};
}

}  // namespace

NetworkPlan plan_network(NetworkKind kind, int cells) {
  check(cells > 0 && cells % 32 == 0, "the input is halved five times");
  switch (kind) {
    case NetworkKind::Chen20:
      return published_plan(cells, PublishedOutput::kSplineSize);
    case NetworkKind::Affine:
      return published_plan(cells, PublishedOutput::kAffineSize);
    case NetworkKind::Ours:
      return matching_plan(cells, ResidualOutput::kSize);
  }
  check(false, "a kind of network");
  return {};
}

NetworkPlan plan_verification(int cells) {
  check(cells > 0 && cells % 32 == 0, "the input is halved five times");
  return matching_plan(cells, kVerificationOutputs);
}

FoldedNetwork verification_of(const FoldedNetwork& ours) {
  check(ours.plan.outputs == ResidualOutput::kSize, "a network of ours");
  FoldedNetwork network = ours;
  network.plan = plan_verification(ours.plan.cells);
  auto& last = std::get<Linear>(network.layers.back());
  const auto inputs = static_cast<std::size_t>(last.plan.inputs);
  const auto logit = static_cast<std::size_t>(ResidualOutput::kInlierLogit);
  Linear told{.plan = std::get<LinearPlan>(network.plan.layers.back())};
  for (const float sign : {-0.5F, 0.5F}) {
    for (std::size_t i = 0; i < inputs; ++i) {
      told.weights.push_back(sign * last.weights[logit * inputs + i]);
    }
    told.bias.push_back(sign * last.bias[logit]);
  }
  last = std::move(told);
  return network;
}

}  // namespace sketchloc

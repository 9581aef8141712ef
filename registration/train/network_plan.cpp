#include "registration/train/network_plan.hpp"

#include "motion/check.hpp"
#include "registration/network_output.hpp"

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

NetworkPlan matching_plan(int cells) {
  const int left = cells / 16;
  const MatchPlan match{.scan_channels = 2, .drawing_channels = 3};
  return {.channels = channels_of(InputKind::Residual),
          .cells = cells,
          .outputs = ResidualOutput::kSize,
          .layers = {match, ConvolutionPlan{match.outputs(), 64, 2}, ResidualPlan{64},
                     ConvolutionPlan{64, 128, 2}, ResidualPlan{128},
                     LinearPlan{128 * left * left, 256, true},
                     LinearPlan{256, ResidualOutput::kSize, false}}};
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
      return matching_plan(cells);
  }
  check(false, "a kind of network");
  return {};
}

}  // namespace sketchloc

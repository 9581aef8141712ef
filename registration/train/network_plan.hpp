#pragma once

#include <string>
#include <variant>
#include <vector>

#include "registration/correlation.hpp"
#include "registration/network_kind.hpp"

namespace sketchloc {

/// 3x3, padded by 1, batch normalisation, ReLU.
struct ConvolutionPlan {
  int inputs = 1;
  int outputs = 1;
  int stride = 1;
};

/// x + two convolutions of x, then ReLU.
struct ResidualPlan {
  int channels = 1;
};

/// Fully connected; the first one takes all cells of all channels. Hidden ones have batch
/// normalisation and ReLU.
struct LinearPlan {
  int inputs = 1;
  int outputs = 1;
  bool hidden = false;
};

/// The first channels of the input are the scan's, the others the drawing's. Each passes through
/// two convolutions of stride 2 and a residual block of its own; then come both results and their
/// correlation (see correlate).
struct MatchPlan {
  int scan_channels = 1;
  int drawing_channels = 1;
  int first_width = 16;
  int width = 32;

  int outputs() const { return 2 * width + kCorrelationShifts; }
};

using LayerPlan = std::variant<ConvolutionPlan, ResidualPlan, MatchPlan, LinearPlan>;

/// A network as data: training builds it, export writes it.
struct NetworkPlan {
  int channels = 1;
  int cells = 64;  ///< per side of the input
  int outputs = 1;
  std::vector<LayerPlan> layers{};
};

/// `Chen20`: 5 convolutions of stride 2, 2 of stride 1, 2 fully connected layers. `Affine`: the
/// same with 6 outputs. `Ours`: features of scan and drawing are matched, then residual blocks.
/// `cells`: a multiple of 32.
NetworkPlan plan_network(NetworkKind kind, int cells);

/// `Ours`, but for its outputs: wrong and right.
NetworkPlan plan_verification(int cells);

// The same with its numbers, batch normalisation folded in.

struct Convolution {
  ConvolutionPlan plan;
  bool relu = true;
  std::vector<float> weights{};  ///< outputs x inputs x 3 x 3
  std::vector<float> bias{};
};

struct Residual {
  Convolution first;
  Convolution second;  ///< its ReLU comes after the sum
};

struct Encoder {
  Convolution first;
  Convolution second;
  Residual third;
};

struct Match {
  MatchPlan plan;
  Encoder scan;
  Encoder drawing;
};

struct Linear {
  LinearPlan plan;
  std::vector<float> weights{};  ///< outputs x inputs
  std::vector<float> bias{};
};

struct FoldedNetwork {
  NetworkPlan plan;
  std::vector<std::variant<Convolution, Residual, Match, Linear>> layers{};
};

/// The verification network to begin with: all that a network of ours knows, its inlier logit as
/// the difference of right and wrong.
FoldedNetwork verification_of(const FoldedNetwork& ours);

/// The bytes of an ONNX file: inputs kScanInput and kDrawingInput of a network that begins with a
/// match, else kStackedInput; output "output". Each of 1 x channels x cells x cells.
std::string onnx_bytes(const FoldedNetwork& network);

/// The other way: the numbers that such a file holds. Throws std::runtime_error where it is none,
/// or one of another plan.
FoldedNetwork network_of_onnx(const NetworkPlan& plan, const std::string& bytes);

}  // namespace sketchloc

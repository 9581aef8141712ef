#include "registration/verified_predictor.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "motion/check.hpp"
#include "registration/network_input.hpp"
#include "registration/onnx_network.hpp"

namespace sketchloc {
namespace {

constexpr int kScan = scan_channels_of(InputKind::Residual);
constexpr int kDrawing = channels_of(InputKind::Residual) - kScan;

std::vector<float> run(OnnxNetwork& network, std::span<const float> scan,
                       std::span<const float> drawings, int cells) {
  return network.run(std::array{NetworkPlanes{kScanInput, kScan, cells, scan},
                                NetworkPlanes{kDrawingInput, kDrawing, cells, drawings}});
}

std::vector<float> of_planes(int channels, int cells) {
  return std::vector<float>(static_cast<std::size_t>(channels * cells * cells));
}

/// The network after a look at nothing.
OnnxNetwork usable(std::span<const std::uint8_t> onnx, int cells) try {
  OnnxNetwork network(onnx);
  const std::size_t outputs =
      run(network, of_planes(kScan, cells), of_planes(kDrawing, cells), cells).size();
  if (outputs != kVerificationOutputs) {
    throw std::runtime_error("expected " + std::to_string(kVerificationOutputs) +
                             " outputs, found " + std::to_string(outputs));
  }
  return network;
} catch (const std::runtime_error& error) {
  throw std::runtime_error(std::string("no verification network: ") + error.what());
}

class VerifiedPredictor final : public WarpPredictor {
 public:
  VerifiedPredictor(std::unique_ptr<WarpPredictor> predictor, std::span<const std::uint8_t> onnx,
                    const LocalWindow& window)
      : predictor_(std::move(predictor)),
        network_(usable(onnx, (validate(window), window.cells))),
        window_(window) {}

  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper& drawing,
                                                   std::span<const Sim2> priors) override {
    std::vector<std::optional<Registration>> found = predictor_->predict(submap, drawing, priors);
    std::vector<Registration*> asked;
    std::vector<float> drawings;
    for (std::optional<Registration>& one : found) {
      if (one) {
        const std::vector<float> drawn =
            drawing_input(InputKind::Residual, drawing, one->sketch_from_robot, window_);
        drawings.insert(drawings.end(), drawn.begin(), drawn.end());
        asked.push_back(&*one);
      }
    }
    if (asked.empty()) {
      return found;
    }
    const std::vector<float> outputs =
        run(network_, scan_input(InputKind::Residual, submap, window_), drawings, window_.cells);
    check(outputs.size() == kVerificationOutputs * asked.size(), "outputs for each pose");
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const float wrong = outputs[kVerificationOutputs * i];
      const float right = outputs[kVerificationOutputs * i + 1];
      if (std::isfinite(right - wrong)) {
        asked[i]->place_log_odds = right - wrong;
      }
    }
    return found;
  }

 private:
  std::unique_ptr<WarpPredictor> predictor_;
  OnnxNetwork network_;
  LocalWindow window_;
};

}  // namespace

std::unique_ptr<WarpPredictor> make_verified_predictor(std::unique_ptr<WarpPredictor> predictor,
                                                       std::span<const std::uint8_t> onnx,
                                                       const LocalWindow& window) {
  return std::make_unique<VerifiedPredictor>(std::move(predictor), onnx, window);
}

}  // namespace sketchloc

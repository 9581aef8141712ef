#include "registration/network_predictor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <string>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/network_input.hpp"
#include "registration/network_output.hpp"
#include "registration/onnx_network.hpp"

namespace sketchloc {
namespace {

std::size_t outputs_of(NetworkKind kind) {
  switch (kind) {
    case NetworkKind::Chen20:
      return PublishedOutput::kSplineSize;
    case NetworkKind::Affine:
      return PublishedOutput::kAffineSize;
    case NetworkKind::Ours:
      return ResidualOutput::kSize;
  }
  check(false, "a kind of predictor");
  return 0;
}

constexpr double kMostLogScale = 1.4;  ///< a pose with a scale farther from its prior's is none
constexpr double kLeastSide_px = 8.0;
constexpr double kMostSide_px = 1e5;

bool all_finite(const std::vector<float>& output) {
  return std::ranges::all_of(output, [](float value) { return std::isfinite(value); });
}

bool is_usable(const std::vector<float>& residual_output) {
  return all_finite(residual_output) &&
         std::abs(residual_output[ResidualOutput::kPose + 3]) < kMostLogScale;
}

/// The planes of a scan, and of as many drawings as there are priors, one after the other.
struct Planes {
  std::vector<float> scan;
  std::vector<float> drawings;
};

class NetworkPredictor final : public WarpPredictor {
 public:
  NetworkPredictor(std::span<const std::uint8_t> onnx, NetworkKind kind,
                   const NetworkPredictorParams& params)
      : params_((validate(params), params)), kind_(kind), network_(usable(onnx)) {}

  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper& drawing,
                                                   std::span<const Sim2> priors) override {
    return kind_ == NetworkKind::Ours ? predict_residual(submap, drawing, priors)
                                      : predict_published(submap, drawing, priors);
  }

 private:
  InputKind input_kind() const { return input_of(kind_); }
  std::size_t cells() const {
    return static_cast<std::size_t>(params_.window.cells * params_.window.cells);
  }

  Planes nothing() const {
    const auto of_scan = static_cast<std::size_t>(scan_channels_of(input_kind()));
    const auto all = static_cast<std::size_t>(channels_of(input_kind()));
    return {.scan = std::vector<float>(of_scan * cells(), 0.0F),
            .drawings = std::vector<float>((all - of_scan) * cells(), 0.0F)};
  }

  Planes planes_of(std::span<const PlacedScan> submap, const SketchCropper& drawing,
                   std::span<const Sim2> priors, const LocalWindow& window) const {
    Planes planes{.scan = scan_input(input_kind(), submap, window), .drawings = {}};
    for (const Sim2& prior : priors) {
      const std::vector<float> drawn = drawing_input(input_kind(), drawing, prior, window);
      planes.drawings.insert(planes.drawings.end(), drawn.begin(), drawn.end());
    }
    return planes;
  }

  /// The network after a look at nothing.
  OnnxNetwork usable(std::span<const std::uint8_t> onnx) const try {
    OnnxNetwork network(onnx);
    const std::size_t outputs = forward(network, nothing()).size();
    if (outputs != outputs_of(kind_)) {
      throw std::runtime_error("expected " + std::to_string(outputs_of(kind_)) +
                               " outputs, found " + std::to_string(outputs));
    }
    return network;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("no network of this kind: ") + error.what());
  }

  std::vector<float> forward(OnnxNetwork& network, const Planes& planes) const {
    const int all = channels_of(input_kind());
    const int of_scan = scan_channels_of(input_kind());
    const int cells = params_.window.cells;
    if (input_kind() == InputKind::Residual) {
      return network.run(
          std::array{NetworkPlanes{kScanInput, of_scan, cells, planes.scan},
                     NetworkPlanes{kDrawingInput, all - of_scan, cells, planes.drawings}});
    }
    const std::vector<float> both = stacked(planes);
    return network.run(std::array{NetworkPlanes{kStackedInput, all, cells, both}});
  }

  /// The scan's planes before each drawing's.
  std::vector<float> stacked(const Planes& planes) const {
    const auto each = static_cast<std::ptrdiff_t>(
        static_cast<std::size_t>(channels_of(input_kind())) * cells() - planes.scan.size());
    std::vector<float> both;
    for (auto drawing = planes.drawings.begin(); drawing != planes.drawings.end();
         drawing += each) {
      both.insert(both.end(), planes.scan.begin(), planes.scan.end());
      both.insert(both.end(), drawing, drawing + each);
    }
    return both;
  }

  /// Whether a window around the priors has a size in pixels that a drawing can have.
  bool can_look(std::span<const Sim2> priors) const {
    return !priors.empty() && std::ranges::all_of(priors, [&](const Sim2& prior) {
      const double side_px = params_.window.side_m * prior.scale();
      return side_px > kLeastSide_px && side_px < kMostSide_px;
    });
  }

  /// One row of outputs for each prior.
  std::vector<std::vector<float>> look(std::span<const PlacedScan> submap,
                                       const SketchCropper& drawing, std::span<const Sim2> priors,
                                       const LocalWindow& window) {
    const std::vector<float> output = forward(network_, planes_of(submap, drawing, priors, window));
    const std::size_t width = outputs_of(kind_);
    if (output.size() != priors.size() * width) {
      throw std::runtime_error("the network does not take several inputs at once");
    }
    std::vector<std::vector<float>> rows;
    for (std::size_t i = 0; i < priors.size(); ++i) {
      const float* row = output.data() + i * width;
      rows.emplace_back(row, row + width);
    }
    return rows;
  }

  std::vector<std::optional<Registration>> predict_residual(std::span<const PlacedScan> submap,
                                                            const SketchCropper& drawing,
                                                            std::span<const Sim2> priors) {
    std::vector<std::optional<Registration>> results(priors.size());
    if (!can_look(priors)) {
      return results;
    }
    std::vector<Sim2> from(priors.begin(), priors.end());
    LocalWindow window = params_.window;
    for (int taken = 0; taken < params_.looks; ++taken) {
      window.side_m = taken == 0 ? params_.window.side_m : params_.fine_side_m;
      const std::vector<std::vector<float>> outputs = look(submap, drawing, from, window);
      for (std::size_t i = 0; i < from.size(); ++i) {
        if (!is_usable(outputs[i])) {
          continue;  // what an earlier look found stands
        }
        const Sim2 pose = pose_of_residual(outputs[i], from[i], window);
        results[i] = Registration{.warp = warp_of_residual(outputs[i], from[i], window),
                                  .window = window,
                                  .sketch_from_robot = pose,
                                  .covariance = covariance_of_residual(outputs[i], window),
                                  .inlier_probability = inlier_probability_of_residual(outputs[i])};
        from[i] = pose;
      }
    }
    return results;
  }

  std::vector<std::optional<Registration>> predict_published(std::span<const PlacedScan> submap,
                                                             const SketchCropper& drawing,
                                                             std::span<const Sim2> priors) {
    std::vector<std::optional<Registration>> results(priors.size());
    if (!can_look(priors)) {
      return results;
    }
    const std::vector<std::vector<float>> outputs = look(submap, drawing, priors, params_.window);
    for (std::size_t i = 0; i < priors.size(); ++i) {
      std::vector<float> sources = outputs[i];
      if (kind_ == NetworkKind::Affine) {
        const auto spread = sources_of_affine(outputs[i]);
        sources.assign(spread.begin(), spread.end());
      }
      const Eigen::Vector2d& centre = priors[i].translation();
      const std::optional<Sim2> pose = all_finite(outputs[i])
                                           ? pose_of_published(sources, centre, params_.window)
                                           : std::nullopt;
      if (pose && std::abs(std::log(pose->scale() / priors[i].scale())) < kMostLogScale) {
        results[i] = Registration{.warp = warp_of_published(sources, centre, params_.window),
                                  .window = params_.window,
                                  .sketch_from_robot = *pose,
                                  .covariance = std::nullopt};
      }
    }
    return results;
  }

  NetworkPredictorParams params_;
  NetworkKind kind_;
  OnnxNetwork network_;
};

}  // namespace

void validate(const NetworkPredictorParams& params) {
  validate_part("window", params.window);
  require_in_range("looks", params.looks, 1, 10);
  require_above("fine_side_m", params.fine_side_m, 0.0);
}

void run_networks_on_one_thread() { cv::setNumThreads(1); }

std::unique_ptr<WarpPredictor> make_network_predictor(std::span<const std::uint8_t> onnx,
                                                      NetworkKind kind,
                                                      const NetworkPredictorParams& params) {
  return std::make_unique<NetworkPredictor>(onnx, kind, params);
}

}  // namespace sketchloc

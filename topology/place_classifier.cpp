#include "topology/place_classifier.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/network_input.hpp"

namespace sketchloc {
namespace {

constexpr int kChannels = scan_channels_of(InputKind::Residual);

std::vector<float> run(OnnxNetwork& network, std::span<const float> planes, int cells) {
  return network.run(std::array{NetworkPlanes{kStackedInput, kChannels, cells, planes}});
}

/// The network after a look at nothing.
OnnxNetwork usable(std::span<const std::uint8_t> onnx, int cells) try {
  OnnxNetwork network(onnx);
  const std::vector<float> nothing(static_cast<std::size_t>(kChannels * cells * cells));
  if (const std::size_t outputs = run(network, nothing, cells).size(); outputs != kPlaceLabels) {
    throw std::runtime_error("expected " + std::to_string(kPlaceLabels) + " outputs, found " +
                             std::to_string(outputs));
  }
  return network;
} catch (const std::runtime_error& error) {
  throw std::runtime_error(std::string("no network that tells kinds of places: ") + error.what());
}

using State = Eigen::Vector3d;  ///< one number for each label
static_assert(kPlaceLabels == 3);

State evidence_of(const PlaceProbabilities& told) {
  return State(told[0], told[1], told[2]).cwiseMax(1e-6);
}

/// After a way: it may have become any other kind of place.
State after(const State& before, double way_m, const PlaceClassifierParams& params) {
  const double stays = std::exp(-way_m / params.stay_way_m);
  return stays * before + State::Constant((1.0 - stays) * before.sum() / kPlaceLabels);
}

State normalised(const State& state) { return state / state.sum(); }

}  // namespace

void validate(const PlaceClassifierParams& params) {
  validate_part("window", params.window);
  validate_part("scans", params.scans);
  require_above("stay_way_m", params.stay_way_m, 0.0);
}

std::vector<float> place_input(std::span<const PlacedScan> submap, const LocalWindow& window) {
  return scan_input(InputKind::Residual, submap, window);
}

PlaceLabel likeliest(const PlaceProbabilities& probabilities) {
  return static_cast<PlaceLabel>(std::ranges::max_element(probabilities) - probabilities.begin());
}

PlaceClassifier::PlaceClassifier(std::span<const std::uint8_t> onnx,
                                 const PlaceClassifierParams& params)
    : params_((validate(params), params)), network_(usable(onnx, params.window.cells)) {}

PlaceProbabilities PlaceClassifier::classify(std::span<const PlacedScan> submap) {
  check(!submap.empty(), "there is a scan to look at");
  const std::vector<float> logits =
      run(network_, place_input(submap, params_.window), params_.window.cells);
  const double largest = *std::ranges::max_element(logits);
  PlaceProbabilities probabilities;
  double sum = 0.0;
  for (std::size_t i = 0; i < kPlaceLabels; ++i) {
    probabilities[i] = std::exp(logits[i] - largest);
    sum += probabilities[i];
  }
  for (double& probability : probabilities) {
    probability /= sum;
  }
  return probabilities;
}

std::vector<PlaceLabel> classify_places(PlaceClassifier& classifier, std::span<const Scan> scans,
                                        std::span<const Se2> odom_from_robot) {
  check(scans.size() == odom_from_robot.size(), "one pose for each scan");
  const PlaceClassifierParams& params = classifier.params();
  const std::size_t count = scans.size();
  RecentScans recent(params.scans);
  std::vector<State> evidence;
  std::vector<double> way_m;  // to the next scan
  for (std::size_t i = 0; i < count; ++i) {
    recent.add(scans[i], odom_from_robot[i]);
    evidence.push_back(evidence_of(classifier.classify(recent.placed())));
    way_m.push_back(
        i + 1 == count
            ? 0.0
            : (odom_from_robot[i + 1].translation() - odom_from_robot[i].translation()).norm());
  }
  std::vector<State> later(count, State::Ones());  // what the scans behind say
  for (std::size_t i = count; i-- > 1;) {
    later[i - 1] = normalised(after(later[i].cwiseProduct(evidence[i]), way_m[i - 1], params));
  }
  std::vector<PlaceLabel> labels;
  State sofar = State::Ones();
  for (std::size_t i = 0; i < count; ++i) {
    sofar = normalised(sofar.cwiseProduct(evidence[i]));
    const State all = sofar.cwiseProduct(later[i]);
    labels.push_back(likeliest({all[0], all[1], all[2]}));
    sofar = after(sofar, way_m[i], params);
  }
  return labels;
}

}  // namespace sketchloc

#include "topology/place_comparator.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "registration/network_input.hpp"

namespace sketchloc {
namespace {

constexpr double kUnit_m = 10.0;

std::vector<float> run(OnnxNetwork& network, std::span<const float> nodes) {
  return network.run(std::array{NetworkPlanes{kStackedInput, kComparatorInputs, 1, nodes}});
}

/// The network after a look at two nodes.
OnnxNetwork usable(std::span<const std::uint8_t> onnx) try {
  OnnxNetwork network(onnx);
  const std::vector<float> nothing(std::size_t{2} * kComparatorInputs);
  const std::size_t outputs = run(network, nothing).size();
  if (outputs != std::size_t{2} * kComparatorOutputs) {
    throw std::runtime_error("expected 2 x 8 outputs, found " + std::to_string(outputs));
  }
  return network;
} catch (const std::runtime_error& error) {
  throw std::runtime_error(std::string("no network that compares places: ") + error.what());
}

std::array<float, kComparatorInputs> input_of(const NodeEnds& node, const Eigen::Vector2d& middle) {
  Eigen::Vector2d low = (node.from_in_manhattan - middle) / kUnit_m;
  Eigen::Vector2d high = (node.to_in_manhattan - middle) / kUnit_m;
  if (low.sum() > high.sum()) {
    std::swap(low, high);
  }
  return {static_cast<float>(low.x()), static_cast<float>(low.y()), static_cast<float>(high.x()),
          static_cast<float>(high.y())};
}

}  // namespace

std::array<std::array<float, kComparatorInputs>, 2> comparator_input(const NodeEndsPair& pair) {
  const auto& [first, second] = pair;
  const Eigen::Vector2d middle = 0.25 * (first.from_in_manhattan + first.to_in_manhattan +
                                         second.from_in_manhattan + second.to_in_manhattan);
  return {input_of(first, middle), input_of(second, middle)};
}

PlaceComparator::PlaceComparator(std::span<const std::uint8_t> onnx) : network_(usable(onnx)) {}

std::vector<double> PlaceComparator::distances(std::span<const NodeEndsPair> pairs) {
  std::vector<double> distances;
  if (pairs.empty()) {
    return distances;
  }
  std::vector<float> nodes;
  for (const NodeEndsPair& pair : pairs) {
    for (const auto& node : comparator_input(pair)) {
      nodes.insert(nodes.end(), node.begin(), node.end());
    }
  }
  const std::vector<float> points = run(network_, nodes);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto point = [&](std::size_t node) {
      return Eigen::Map<const Eigen::Matrix<float, kComparatorOutputs, 1>>(
          points.data() + node * kComparatorOutputs);
    };
    distances.push_back((point(2 * i) - point(2 * i + 1)).norm());
  }
  return distances;
}

}  // namespace sketchloc

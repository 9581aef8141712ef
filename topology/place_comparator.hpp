#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "registration/onnx_network.hpp"

namespace sketchloc {

/// Where a node of the topology lies: its ends in the Manhattan frame.
struct NodeEnds {
  Eigen::Vector2d from_in_manhattan = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_in_manhattan = Eigen::Vector2d::Zero();
};

struct NodeEndsPair {
  NodeEnds first;
  NodeEnds second;
};

inline constexpr int kComparatorInputs = 4;
inline constexpr int kComparatorOutputs = 8;

/// What the comparator sees of the first node and of the second: both ends, the one with the
/// smaller coordinates first, about the middle of both nodes, in units of 10 m. [Topo20] has the
/// building's own frame; about the middle there is nothing to learn of where a pair lies.
std::array<std::array<float, kComparatorInputs>, 2> comparator_input(const NodeEndsPair& pair);

/// The Siamese comparator of [Topo20]: a multilayer perceptron that takes two nodes of one place to
/// one point, and nodes of different places more than 1 apart. Not safe to share between threads.
class PlaceComparator {
 public:
  /// A network that `sketchloc train --network same-place` made, as the bytes of an ONNX file.
  /// Throws std::runtime_error where it is none.
  explicit PlaceComparator(std::span<const std::uint8_t> onnx);

  /// Distances of the points that the nodes are taken to, one for each pair.
  std::vector<double> distances(std::span<const NodeEndsPair> pairs);

 private:
  OnnxNetwork network_;
};

}  // namespace sketchloc

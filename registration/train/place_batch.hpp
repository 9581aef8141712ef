#pragma once

#include <cstdint>
#include <vector>

namespace sketchloc {

/// Inputs of a network with the right answers, side by side.
struct PlaceBatch {
  int count = 0;  ///< answers
  /// One sample after the other; where pairs are compared, the first nodes of all pairs and then
  /// the second ones.
  std::vector<float> input = {};
  /// PlaceLabel; or 1 for a pair of one place and where the robot is, else 0.
  std::vector<std::int64_t> answer = {};
};

}  // namespace sketchloc

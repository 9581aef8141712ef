#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "smoothing/keyframe.hpp"
#include "smoothing/smoothing_params.hpp"

namespace sketchloc {

/// Which of its hypotheses each keyframe takes.
struct Branch {
  /// Index of the hypothesis of each keyframe on the likeliest path through all of them; none where
  /// a keyframe has no hypothesis.
  std::vector<std::optional<std::size_t>> chosen;
  /// The probability of each hypothesis of each keyframe, given all of them. What is missing to one
  /// is that of the robot having been elsewhere.
  std::vector<std::vector<double>> probability;
};

/// A hidden Markov model over the hypotheses of the keyframes: a registration says how probable its
/// hypothesis is, the odometry which hypotheses follow each other, and any may be left for any
/// other at small odds. The likeliest path [Viterbi67] and the marginals (forward, backward).
Branch find_branch(const KeyframeRun& run, const SmoothingParams& params);

}  // namespace sketchloc

#pragma once

#include <vector>

#include "motion/pose_graph.hpp"

namespace sketchloc {

/// As linear_start(), but an edge that may be wrong counts only where at least `witnesses` others
/// near it close a loop with it within `width` standard deviations, and in each of the two systems
/// only where it agrees with the rest of them (truncated least squares, reached from the convex
/// problem [Yang20]).
std::vector<GraphPose> robust_start(const PoseGraph& graph, double width, int witnesses);

}  // namespace sketchloc

#pragma once

#include <span>
#include <vector>

#include "motion/pose_graph.hpp"

namespace sketchloc::detail {

/// For each edge that may be wrong: how many other such edges between its surroundings, a few
/// edges that are sure away at both ends, close a loop with it within `width` standard deviations.
/// Wrong ones seldom agree with each other. Of other edges 0. All are Between edges.
std::vector<int> agreeing_edges(std::span<const GraphEdge> edges, std::size_t vertices,
                                double width);

}  // namespace sketchloc::detail

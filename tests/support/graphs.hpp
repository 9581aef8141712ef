#pragma once

#include <vector>

#include "motion/pose_graph.hpp"
#include "motion/random.hpp"

namespace sketchloc::testing {

/// A robot that drives on a grid of streets and knows places again.
struct SimulatedGraph {
  PoseGraph truth;
  PoseGraph measured;  ///< vertices by dead reckoning; the first one fixed
};

/// `poses` of 1 m, a turn of a quarter at every fourth one in three; loop closures of neighbours of
/// earlier poses with this chance each; noise of 5 cm and 0.02 rad.
SimulatedGraph simulated_graph(std::size_t poses, double loop_chance, Rng& rng);

/// Edges that may be wrong.
std::size_t doubted(const PoseGraph& graph);

/// The graph with so many more edges that may be wrong, and are: between random vertices, with the
/// measurement of a random one that was there.
PoseGraph with_random_loops(PoseGraph graph, std::size_t count, Rng& rng);

/// The largest distance between two poses of one index.
double worst_distance_m(const std::vector<GraphPose>& a, const std::vector<GraphPose>& b);

}  // namespace sketchloc::testing

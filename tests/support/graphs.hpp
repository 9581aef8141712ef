#pragma once

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

}  // namespace sketchloc::testing

#pragma once

#include "motion/pose_graph.hpp"
#include "motion/random.hpp"

namespace sketchloc {

/// The graph with loop closures that are wrong, so many that they are this share (0 to below 1) of
/// all that may be wrong: between random vertices, each with the measurement and the information of
/// a random true one, as from a place that looks the same. Without true ones it stays as it is.
PoseGraph with_wrong_loops(PoseGraph graph, double share, Rng& rng);

}  // namespace sketchloc

#pragma once

#include <vector>

#include "motion/pose_graph.hpp"

namespace sketchloc {

/// Poses that agree with the Between edges as well as two linear systems can say, whatever the
/// vertices' poses are: first the headings, by the chordal relaxation [Carlone15], then positions.
/// Each connected part keeps the pose of one vertex (a fixed one where there is one; else the first
/// one); scales, and vertices without such edges, stay as they are. Headings are in (-pi, pi].
std::vector<GraphPose> linear_start(const PoseGraph& graph);

/// The poses of dead reckoning: each vertex placed by the first edge between it and the vertex that
/// was added before it, the first vertex where it is. Vertices without such an edge stay.
std::vector<GraphPose> dead_reckoning(const PoseGraph& graph);

}  // namespace sketchloc

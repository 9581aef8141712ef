#pragma once

#include <filesystem>
#include <string>

#include "motion/pose_graph.hpp"

namespace sketchloc {

/// Reads a planar pose graph (VERTEX_SE2, EDGE_SE2, EDGE_PRIOR_SE2, FIX), plain or gzip. Vertices
/// and edges may stand in any order. Edges between vertices whose ids are not neighbours are loop
/// closures and may be wrong. Throws std::runtime_error with file, line and advice.
PoseGraph read_g2o(const std::filesystem::path& g2o);

/// The graph as text that read_g2o() reads back as it is, number for number. Rigid vertices,
/// Between edges and priors of them only: throws std::invalid_argument for others.
std::string g2o_text(const PoseGraph& graph);

/// Writes g2o_text() atomically.
void write_g2o(const std::filesystem::path& g2o, const PoseGraph& graph);

}  // namespace sketchloc

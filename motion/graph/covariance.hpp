#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "motion/pose_graph.hpp"

namespace sketchloc {

/// Marginal covariances of (x, y, yaw) of chosen vertices, 3 x 3, or of (x, y, yaw, log scale), 4 x
/// 4, in the frame of the graph and linear at its poses, which should be an optimum. Vertices that
/// stay (see optimise()) have none: zeros. `weights`: one factor per edge, such as those of an
/// OptimiseResult; empty: 1. None where the edges do not determine the poses.
std::optional<std::vector<Eigen::MatrixXd>> covariances(const PoseGraph& graph,
                                                        std::span<const std::size_t> vertices,
                                                        std::span<const double> weights = {});

}  // namespace sketchloc

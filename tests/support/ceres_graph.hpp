#pragma once

#include <Eigen/Core>
#include <vector>

#include "motion/pose_graph.hpp"

namespace sketchloc::testing {

/// What plain Ceres makes of a graph: the independent answer for motion/graph, and the baseline of
/// its benchmark.
struct CeresAnswer {
  std::vector<GraphPose> poses;
  double chi2 = 0.0;
  int iterations = 0;
};

/// Dogleg from the vertices' poses, analytic Jacobians written out by hand, sparse normal Cholesky
/// with SuiteSparse, one thread. Rigid vertices and Between edges only; fixed vertices, or else the
/// first one, stay.
CeresAnswer ceres_optimum(const PoseGraph& graph, double cost_tolerance = 1e-6);

/// Marginal covariances of (x, y, yaw) at the vertices' poses, by ceres::Covariance.
std::vector<Eigen::Matrix3d> ceres_covariances(const PoseGraph& graph,
                                               const std::vector<std::size_t>& vertices);

}  // namespace sketchloc::testing

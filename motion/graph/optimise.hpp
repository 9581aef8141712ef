#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "motion/graph/kernel.hpp"
#include "motion/pose_graph.hpp"

namespace sketchloc {

/// Where the optimization begins.
enum class GraphStart {
  Given,   ///< at the vertices' poses
  Linear,  ///< at linear_start(), behind a kernel at robust_start(), whatever the poses are
  Better,  ///< at the one of these two that costs less
};
std::span<const std::pair<std::string_view, GraphStart>> names_of(GraphStart);

struct OptimiseParams {
  RobustKernel kernel = {};
  GraphStart initial = GraphStart::Better;
  int most_iterations = 100;     ///< linear systems that are factorised per problem, > 0
  double cost_tolerance = 1e-6;  ///< done where a step lowers the cost by less than this share, > 0
  double start_radius = 1e4;     ///< of the trust region, in standard deviations, > 0
  double graduation = 1.4;       ///< factor between the problems of the graduated kernel, > 1
};
void validate(const OptimiseParams& params);

template <typename Visitor>
void visit_fields(OptimiseParams& params, Visitor&& visit) {
  visit("kernel", params.kernel);
  visit("initial", params.initial);
  visit("most_iterations", params.most_iterations);
  visit("cost_tolerance", params.cost_tolerance);
  visit("start_radius", params.start_radius);
  visit("graduation", params.graduation);
}

struct OptimiseResult {
  enum class Status {
    Converged,
    IterationLimit,
    Singular,  ///< the measurements do not determine the poses
  };
  Status status = Status::Singular;
  std::vector<GraphPose> poses = {};  ///< of the vertices, the best so far whatever the status
  std::vector<double> weights = {};   ///< of the edges at the end, 0 (taken for wrong) to 1
  double start_chi2 = 0.0;            ///< of the vertices' poses, see chi2()
  double chi2 = 0.0;                  ///< of `poses`
  double cost = 0.0;                  ///< chi2 behind the kernel: what was minimized
  int iterations = 0;                 ///< linear systems that were factorised
};

/// Moves the vertices to where the measurements agree best: least squares behind the kernel, by
/// Powell's dogleg on the normal equations [Rosen12]. The graduated kernel solves a sequence of
/// problems from several starts, given or robust, and keeps the best end; the others begin there
/// (or at the poses given). Vertices that are fixed stay; in a part of
/// the graph without one and without a prior the first (rigid) vertex stays. Headings are not
/// wrapped. An empty graph is converged. Throws std::invalid_argument where validate() does.
OptimiseResult optimise(const PoseGraph& graph, const OptimiseParams& params = {});

/// Sum over the edges of r^T information r, without kernels and without a factor 1/2.
double chi2(const PoseGraph& graph);
/// The same, edge by edge.
std::vector<double> chi2_of_edges(const PoseGraph& graph);

/// The same graph with its vertices at these poses.
PoseGraph with_poses(PoseGraph graph, std::span<const GraphPose> poses);

}  // namespace sketchloc

#include "motion/graph/optimise.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "motion/check.hpp"
#include "motion/graph/detail/descent.hpp"
#include "motion/graph/linear_start.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

using detail::Descent;
using detail::EdgeWeighting;
using detail::NormalEquations;
using Status = OptimiseResult::Status;

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The weights of truncated least squares at a stage of graduation: [Yang20 eq. 14], where mu goes
/// from 0 (convex) to infinity (truncated).
std::vector<double> graduated_weights(const PoseGraph& graph, const std::vector<double>& chi2,
                                      double width, double mu) {
  std::vector<double> weights(chi2.size(), 1.0);
  const double bound = width * width;
  for (std::size_t i = 0; i < chi2.size(); ++i) {
    if (!graph.edges[i].may_be_wrong || chi2[i] <= mu / (mu + 1.0) * bound) {
      continue;
    }
    weights[i] = chi2[i] >= (mu + 1.0) / mu * bound
                     ? 0.0
                     : width / std::sqrt(chi2[i]) * std::sqrt(mu * (mu + 1.0)) - mu;
  }
  return weights;
}

/// The largest error of an edge that may be wrong.
double worst_chi2(const PoseGraph& graph, const std::vector<double>& chi2) {
  double worst = 0.0;
  for (std::size_t i = 0; i < chi2.size(); ++i) {
    worst = graph.edges[i].may_be_wrong ? std::max(worst, chi2[i]) : worst;
  }
  return worst;
}

bool is_binary(const std::vector<double>& weights) {
  return std::ranges::all_of(weights, [](double w) { return w < 1e-3 || w > 1.0 - 1e-3; });
}

/// Least squares with fewer and fewer of the edges that disagree [Yang20].
Status graduate(const PoseGraph& graph, NormalEquations& equations, Descent& descent,
                const OptimiseParams& params, std::vector<double>& weights) {
  descent.run({}, params.most_iterations);
  const double bound = params.kernel.width * params.kernel.width;
  double mu = bound / (2.0 * worst_chi2(graph, equations.chi2_of_edges(descent.poses())) - bound);
  if (!(mu > 0.0)) {
    return Status::Converged;  // no edge is farther off than the width
  }
  Status status = Status::IterationLimit;
  const int most = 10 * params.most_iterations;
  while (descent.iterations() < most) {
    weights =
        graduated_weights(graph, equations.chi2_of_edges(descent.poses()), params.kernel.width, mu);
    if (mu > 1.0 && is_binary(weights)) {
      return descent.run({.given = weights}, params.most_iterations);
    }
    status = descent.run({.given = weights}, 1);
    if (status == Status::Singular) {
      return status;
    }
    mu *= params.graduation;
  }
  return status;
}

std::vector<double> kernel_weights(const PoseGraph& graph, const std::vector<double>& chi2,
                                   const RobustKernel& kernel) {
  std::vector<double> weights(chi2.size(), 1.0);
  for (std::size_t i = 0; i < chi2.size(); ++i) {
    if (graph.edges[i].may_be_wrong) {
      weights[i] = robust_weight(kernel, chi2[i]);
    }
  }
  return weights;
}

std::vector<GraphPose> start_poses(const PoseGraph& graph, const NormalEquations& equations,
                                   const OptimiseParams& params) {
  std::vector<GraphPose> given = detail::poses_of(graph);
  if (params.initial == GraphStart::Given) {
    return given;
  }
  std::vector<GraphPose> linear = linear_start(graph);
  const EdgeWeighting weighting{.kernel = params.kernel};
  const bool is_better = params.initial == GraphStart::Linear ||
                         equations.cost(linear, weighting) < equations.cost(given, weighting);
  return is_better ? linear : given;
}

}  // namespace

std::span<const std::pair<std::string_view, GraphStart>> names_of(GraphStart /*start*/) {
  static constexpr auto kNames =
      std::to_array<std::pair<std::string_view, GraphStart>>({{"given", GraphStart::Given},
                                                              {"linear", GraphStart::Linear},
                                                              {"better", GraphStart::Better}});
  return kNames;
}

void validate(const OptimiseParams& params) {
  validate_part("kernel", params.kernel);
  require_at_least("most_iterations", params.most_iterations, 1.0);
  require_above("cost_tolerance", params.cost_tolerance, 0.0);
  require_above("start_radius", params.start_radius, 0.0);
  require_above("graduation", params.graduation, 1.0);
}

OptimiseResult optimise(const PoseGraph& graph, const OptimiseParams& params) {
  validate(graph);
  validate(params);
  NormalEquations equations(graph, detail::held_vertices(graph));
  OptimiseResult result;
  result.status = Status::Converged;
  result.poses = detail::poses_of(graph);
  result.start_chi2 = result.chi2 = result.cost = sum(equations.chi2_of_edges(result.poses));
  result.weights.assign(graph.edges.size(), 1.0);
  if (equations.unknowns().size() == 0) {
    return result;
  }
  Descent descent(equations, start_poses(graph, equations, params), params);
  const bool is_graduated = params.kernel.shape == KernelShape::Graduated;
  result.status = is_graduated ? graduate(graph, equations, descent, params, result.weights)
                               : descent.run({.kernel = params.kernel}, params.most_iterations);
  result.poses = descent.poses();
  result.iterations = descent.iterations();
  const std::vector<double> chi2_of_edges = equations.chi2_of_edges(result.poses);
  result.chi2 = sum(chi2_of_edges);
  result.cost = equations.cost(result.poses, {.kernel = params.kernel});
  if (!is_graduated) {
    result.weights = kernel_weights(graph, chi2_of_edges, params.kernel);
  }
  return result;
}

std::vector<double> chi2_of_edges(const PoseGraph& graph) {
  const std::vector<bool> all_held(graph.vertices.size(), true);
  return NormalEquations(graph, all_held).chi2_of_edges(detail::poses_of(graph));
}

double chi2(const PoseGraph& graph) { return sum(chi2_of_edges(graph)); }

PoseGraph with_poses(PoseGraph graph, std::span<const GraphPose> poses) {
  check(poses.size() == graph.vertices.size(), "one pose per vertex");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    graph.vertices[i].frame_from_body = poses[i];
  }
  return graph;
}

}  // namespace sketchloc

#include "motion/graph/optimise.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "motion/check.hpp"
#include "motion/graph/detail/graduation.hpp"
#include "motion/graph/detail/thinned_descent.hpp"
#include "motion/graph/linear_start.hpp"
#include "motion/graph/robust_start.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

using detail::Descent;
using detail::EdgeWeighting;
using detail::NormalEquations;
using detail::ThinnedDescent;
using detail::TruncatedOptimum;
using Status = OptimiseResult::Status;

/// Witnesses that an edge which may be wrong needs to count at a start. Many let little through
/// that is wrong; where places are seldom seen again few edges have more than one. None needed is
/// the start for graphs with a few wrong edges; of more than kMostUnwitnessed edges the wrong ones
/// could fill the matrix.
constexpr std::array kWitnesses = {4, 2, 1, 0};
constexpr std::ptrdiff_t kMostUnwitnessed = 1000;

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::ptrdiff_t doubted_edges(const PoseGraph& graph) {
  return std::ranges::count(graph.edges, true, &GraphEdge::may_be_wrong);
}

/// Whether the kernel has an edge to act on.
bool has_doubts(const PoseGraph& graph, const OptimiseParams& params) {
  return params.kernel.shape != KernelShape::None && doubted_edges(graph) > 0;
}

std::vector<GraphPose> start_poses(const PoseGraph& graph, const NormalEquations& equations,
                                   GraphStart initial) {
  std::vector<GraphPose> given = detail::poses_of(graph);
  if (initial == GraphStart::Given) {
    return given;
  }
  std::vector<GraphPose> linear = linear_start(graph);
  const bool is_better =
      initial == GraphStart::Linear || equations.cost(linear, {}) < equations.cost(given, {});
  return is_better ? linear : given;
}

void move(const PoseGraph& graph, NormalEquations& equations, const OptimiseParams& params,
          OptimiseResult& result) {
  Descent descent(equations, start_poses(graph, equations, params.initial), params);
  result.status = descent.run({}, params.most_iterations);
  result.poses = descent.poses();
  result.iterations = descent.iterations();
}

/// From several starts, the best end: a single wrong edge that is taken for right at the start can
/// turn half of a graph, and what that costs shows in the end only. Where no edge is taken for
/// wrong there is nothing to gain.
TruncatedOptimum best_truncated_optimum(const PoseGraph& graph, const OptimiseParams& params) {
  TruncatedOptimum best;
  int iterations = 0;
  const auto try_from = [&](std::vector<GraphPose> start) {
    TruncatedOptimum next = detail::truncated_optimum(graph, std::move(start), params);
    iterations += next.iterations;
    if (best.poses.empty() || next.cost < best.cost) {
      best = std::move(next);
    }
  };
  const auto is_done = [&best] { return !best.poses.empty() && !best.rejects; };
  for (const int witnesses : kWitnesses) {
    const bool is_affordable = witnesses > 0 || doubted_edges(graph) <= kMostUnwitnessed;
    if (params.initial != GraphStart::Given && is_affordable && !is_done()) {
      try_from(robust_start(graph, params.kernel.width, witnesses));
    }
  }
  if (params.initial != GraphStart::Linear && !is_done()) {
    try_from(detail::poses_of(graph));
  }
  best.iterations = iterations;
  return best;
}

/// Kernels that are not truncated begin at the truncated optimum, unless the poses given are
/// better.
void move_robustly(const PoseGraph& graph, const NormalEquations& costs,
                   const OptimiseParams& params, OptimiseResult& result) {
  TruncatedOptimum truncated;
  const bool is_truncated = params.kernel.shape == KernelShape::Graduated;
  if (is_truncated || params.initial != GraphStart::Given) {
    truncated = best_truncated_optimum(graph, params);
    result.iterations = truncated.iterations;
  }
  if (is_truncated) {
    result.status = truncated.status;
    result.poses = std::move(truncated.poses);
    return;
  }
  const EdgeWeighting weighting{.kernel = params.kernel};
  const bool is_better =
      params.initial == GraphStart::Linear ||
      (params.initial == GraphStart::Better &&
       costs.cost(truncated.poses, weighting) < costs.cost(result.poses, weighting));
  ThinnedDescent descent(graph, is_better ? std::move(truncated.poses) : result.poses, params);
  result.status = descent.run(weighting, params.most_iterations);
  result.poses = descent.poses();
  result.iterations += descent.iterations();
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
  const std::vector<bool> held = detail::held_vertices(graph);
  const bool is_robust = has_doubts(graph, params);
  // Behind a kernel they only tell costs.
  NormalEquations equations(graph, is_robust ? std::vector<bool>(held.size(), true) : held);
  OptimiseResult result;
  result.status = Status::Converged;
  result.poses = detail::poses_of(graph);
  result.start_chi2 = sum(equations.chi2_of_edges(result.poses));
  if (std::ranges::count(held, false) > 0) {
    is_robust ? move_robustly(graph, equations, params, result)
              : move(graph, equations, params, result);
  }
  const EdgeWeighting weighting{.kernel = params.kernel};
  result.chi2 = sum(equations.chi2_of_edges(result.poses));
  result.cost = equations.cost(result.poses, weighting);
  result.weights = equations.weights(result.poses, weighting);
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

#include "motion/graph/detail/graduation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/graph/detail/thinned_descent.hpp"

namespace sketchloc::detail {
namespace {

using Status = OptimiseResult::Status;

constexpr double kFirstWidths = 10.0;  ///< errors beyond so many count nothing in any problem
constexpr double kMostMu = 1e6;        ///< truncated, as far as numbers tell
constexpr int kMostRounds = 20;        ///< of edges that change sides

RobustKernel truncated_at(const OptimiseParams& params) {
  return {.shape = KernelShape::Graduated, .width = params.kernel.width};
}

/// Status::Singular, or that of the last problem's first step.
Status graduate(const PoseGraph& graph, ThinnedDescent& descent, const OptimiseParams& params) {
  const double bound = params.kernel.width * params.kernel.width;
  double mu = 1.0 / (kFirstWidths * kFirstWidths - 1.0);
  for (bool is_done = false; !is_done; mu *= params.graduation) {
    std::vector<double> weights = descent.chi2_of_edges();
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weights[i] = graph.edges[i].may_be_wrong ? graduated_weight(weights[i], bound, mu) : 1.0;
    }
    if (descent.run({.given = weights}, 1) == Status::Singular) {
      return Status::Singular;
    }
    is_done = mu > 1.0 && (are_decided(weights) || mu > kMostMu);
  }
  return Status::IterationLimit;
}

Status truncate(ThinnedDescent& descent, const OptimiseParams& params) {
  std::vector<double> weights;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<double> next = descent.weights({.kernel = truncated_at(params)});
    if (next == weights) {
      return Status::Converged;
    }
    weights = std::move(next);
    const Status status = descent.run({.given = weights}, params.most_iterations);
    if (status != Status::Converged) {
      return status;
    }
  }
  return Status::IterationLimit;
}

}  // namespace

double convex_mu(std::span<const double> chi2s, double bound) {
  const double worst = chi2s.empty() ? 0.0 : std::ranges::max(chi2s);
  return worst > bound ? bound / (2.0 * worst - bound) : 0.0;
}

double graduated_weight(double chi2, double bound, double mu) {
  if (chi2 <= mu / (mu + 1.0) * bound) {
    return 1.0;
  }
  return chi2 >= (mu + 1.0) / mu * bound ? 0.0 : std::sqrt(bound / chi2 * mu * (mu + 1.0)) - mu;
}

bool are_decided(std::span<const double> weights) {
  return std::ranges::all_of(weights, [](double w) { return w < 1e-3 || w > 1.0 - 1e-3; });
}

TruncatedOptimum truncated_optimum(const PoseGraph& graph, std::vector<GraphPose> poses,
                                   const OptimiseParams& params) {
  ThinnedDescent descent(graph, std::move(poses), params);
  TruncatedOptimum optimum;
  optimum.status = graduate(graph, descent, params);
  if (optimum.status != Status::Singular) {
    optimum.status = truncate(descent, params);
  }
  optimum.poses = descent.poses();
  const EdgeWeighting truncated{.kernel = truncated_at(params)};
  optimum.cost = descent.cost(truncated);
  optimum.rejects = std::ranges::count(descent.weights(truncated), 0.0) > 0;
  optimum.iterations = descent.iterations();
  return optimum;
}

}  // namespace sketchloc::detail

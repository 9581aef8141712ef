#include "motion/graph/robust_start.hpp"

#include <algorithm>

#include "motion/graph/detail/agreement.hpp"
#include "motion/graph/detail/graduation.hpp"
#include "motion/graph/detail/linear_poses.hpp"

namespace sketchloc {
namespace {

using detail::LinearPoses;

constexpr double kGraduation = 2.0;  ///< factor between problems
constexpr int kMostProblems = 60;

/// 1 for edges that are sure, and for those with enough witnesses; else 0.
std::vector<double> witnessed(const LinearPoses& linear, double width, int witnesses) {
  const std::vector<int> agreeing =
      detail::agreeing_edges(linear.edges(), linear.poses().size(), width);
  std::vector<double> weights;
  for (std::size_t i = 0; i < agreeing.size(); ++i) {
    const bool counts = !linear.edges()[i].may_be_wrong || agreeing[i] >= witnesses;
    weights.push_back(counts ? 1.0 : 0.0);
  }
  return weights;
}

/// Solves with fewer and fewer of the doubted edges that disagree; the weights it ends with.
template <typename Solve, typename Errors>
std::vector<double> graduate(std::vector<double> weights, const std::vector<bool>& doubted,
                             double bound, const Solve& solve, const Errors& squared_errors) {
  solve(weights);
  double mu = 0.0;
  for (int problem = 0; problem < kMostProblems; ++problem) {
    std::vector<double> errors = squared_errors();
    for (std::size_t i = 0; i < errors.size(); ++i) {
      errors[i] = doubted[i] ? errors[i] : 0.0;
    }
    mu = problem == 0 ? detail::convex_mu(errors, bound) : mu * kGraduation;
    if (mu == 0.0) {
      return weights;
    }
    for (std::size_t i = 0; i < errors.size(); ++i) {
      weights[i] = doubted[i] ? detail::graduated_weight(errors[i], bound, mu) : weights[i];
    }
    solve(weights);
    if (mu > 1.0 && detail::are_decided(weights)) {
      return weights;
    }
  }
  return weights;
}

/// Edges that count and may be wrong.
std::vector<bool> doubted(const LinearPoses& linear, const std::vector<double>& weights) {
  std::vector<bool> doubted;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    doubted.push_back(linear.edges()[i].may_be_wrong && weights[i] > 0.0);
  }
  return doubted;
}

}  // namespace

std::vector<GraphPose> robust_start(const PoseGraph& graph, double width, int witnesses) {
  LinearPoses linear(graph);
  const double bound = width * width;
  std::vector<double> weights = witnessed(linear, width, witnesses);
  weights = graduate(
      weights, doubted(linear, weights), bound, [&](const auto& given) { linear.turn(given); },
      [&] { return linear.squared_heading_errors(); });
  linear.straighten(weights);
  std::ranges::transform(weights, weights.begin(), [](double w) { return w > 0.5 ? 1.0 : 0.0; });
  graduate(
      weights, doubted(linear, weights), bound, [&](const auto& given) { linear.place(given); },
      [&] { return linear.squared_position_errors(); });
  return linear.poses();
}

}  // namespace sketchloc

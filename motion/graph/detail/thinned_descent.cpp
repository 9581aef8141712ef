#include "motion/graph/detail/thinned_descent.hpp"

#include <algorithm>
#include <utility>

namespace sketchloc::detail {
namespace {

constexpr double kNegligible = 0.1;  ///< weight below which an edge is left out of the matrix
constexpr double kMissed = 0.3;      ///< from which the matrix needs one that was left out
constexpr double kMostIdle = 0.02;   ///< of the matrix's edges may be negligible
constexpr int kIterations = 5;       ///< before the weights are looked at again

}  // namespace

ThinnedDescent::ThinnedDescent(const PoseGraph& graph, std::vector<GraphPose> poses,
                               const OptimiseParams& params)
    : graph_(&graph),
      params_(params),
      held_(held_vertices(graph)),
      costs_(graph, std::vector<bool>(graph.vertices.size(), true)),
      poses_(std::move(poses)) {}

bool ThinnedDescent::fits(const std::vector<double>& weights) const {
  std::size_t joined = 0;
  std::size_t idle = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!joins_[i] && weights[i] > kMissed) {
      return false;
    }
    joined += joins_[i] ? 1U : 0U;
    idle += joins_[i] && weights[i] < kNegligible ? 1U : 0U;
  }
  return static_cast<double>(idle) <= kMostIdle * static_cast<double>(joined);
}

void ThinnedDescent::thin(const std::vector<double>& weights) {
  if (descent_ && fits(weights)) {
    return;
  }
  joins_.resize(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    joins_[i] = !graph_->edges[i].may_be_wrong || weights[i] >= kNegligible;
  }
  params_.start_radius = descent_ ? descent_->radius() : params_.start_radius;
  descent_.reset();
  equations_.emplace(*graph_, held_, nullptr, joins_);
  descent_.emplace(*equations_, poses_, params_);
}

OptimiseResult::Status ThinnedDescent::run(const EdgeWeighting& weighting, int most_iterations) {
  auto status = OptimiseResult::Status::IterationLimit;
  for (int left = most_iterations; left > 0;) {
    thin(weights(weighting));
    const int before = descent_->iterations();
    status = descent_->run(weighting, std::min(left, kIterations));
    poses_ = descent_->poses();
    left -= descent_->iterations() - before;
    iterations_ += descent_->iterations() - before;
    if (status != OptimiseResult::Status::IterationLimit && fits(weights(weighting))) {
      break;
    }
  }
  return status;
}

}  // namespace sketchloc::detail

#include "motion/graph/detail/descent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sketchloc::detail {
namespace {

constexpr double kLeastRadius = 1e-9;
constexpr double kDamping = 1e-9;      ///< of the diagonal where H is singular, first try
constexpr double kMostDamping = 1e-2;  ///< last try

}  // namespace

Descent::Descent(NormalEquations& equations, std::vector<GraphPose> poses,
                 const OptimiseParams& params)
    : equations_(&equations),
      cholesky_(equations.unknowns().pattern()),
      poses_(std::move(poses)),
      tolerance_(params.cost_tolerance),
      radius_(params.start_radius) {}

/// Directions that no edge measures, such as under edges that weigh nothing, are held by damping.
bool Descent::factorise() {
  ++iterations_;
  if (cholesky_.factorise(equations_->values())) {
    return true;
  }
  const Eigen::VectorXd diagonal = equations_->diagonal();
  const double least = 1e-12 * std::max(diagonal.maxCoeff(), 1e-300);
  for (double damping = kDamping; damping <= kMostDamping; damping *= 100.0) {
    equations_->add_to_diagonal((damping * diagonal).cwiseMax(least));
    if (cholesky_.factorise(equations_->values())) {
      return true;
    }
  }
  return false;
}

/// The point where the way over the steepest descent's minimum to Newton's leaves the trust region
/// |scale * step| <= radius.
Eigen::VectorXd Descent::dogleg(const Eigen::VectorXd& newton, const Eigen::VectorXd& scale) const {
  const Eigen::VectorXd& gradient = equations_->gradient();
  const Eigen::VectorXd descent = -gradient.cwiseQuotient(scale.cwiseAbs2());
  const double slope = gradient.dot(descent);
  const Eigen::VectorXd cauchy = (-slope / equations_->curvature(descent)) * descent;
  const double cauchy_length = scale.cwiseProduct(cauchy).norm();
  if (cauchy_length >= radius_) {
    return (radius_ / cauchy_length) * cauchy;
  }
  const Eigen::VectorXd along = newton - cauchy;
  const double a = scale.cwiseProduct(along).squaredNorm();
  const double b = scale.cwiseProduct(along).dot(scale.cwiseProduct(cauchy));
  const double c = cauchy_length * cauchy_length - radius_ * radius_;
  return cauchy + ((-b + std::sqrt(b * b - a * c)) / a) * along;
}

bool Descent::step(const EdgeWeighting& weighting) {
  const Eigen::VectorXd& gradient = equations_->gradient();
  const Eigen::VectorXd newton = -cholesky_.solve(gradient);
  const Eigen::VectorXd scale = equations_->diagonal().cwiseSqrt().cwiseMax(1e-9);
  const double newton_length = scale.cwiseProduct(newton).norm();
  while (radius_ > kLeastRadius) {
    const bool is_newton = newton_length <= radius_;
    const Eigen::VectorXd tried = is_newton ? newton : dogleg(newton, scale);
    const double slope = gradient.dot(tried);
    const double predicted = -2.0 * slope - (is_newton ? -slope : equations_->curvature(tried));
    std::vector<GraphPose> moved = equations_->moved(poses_, tried);
    const double cost = equations_->cost(moved, weighting);
    decrease_ = cost_ - cost;
    const double quality = decrease_ / predicted;
    if (quality > 0.75) {
      radius_ = std::max(radius_, 3.0 * scale.cwiseProduct(tried).norm());
    } else if (quality < 0.25) {
      radius_ = 0.5 * std::min(radius_, scale.cwiseProduct(tried).norm());
    }
    if (decrease_ >= 0.0 && std::isfinite(cost)) {
      poses_ = std::move(moved);
      cost_ = cost;
      return true;
    }
    if (predicted <= tolerance_ * cost_ * 1e-3) {
      return false;  // rounding is all that is left
    }
  }
  return false;
}

OptimiseResult::Status Descent::run(const EdgeWeighting& weighting, int most_iterations) {
  cost_ = equations_->cost(poses_, weighting);
  for (int i = 0; i < most_iterations; ++i) {
    equations_->linearise(poses_, weighting);
    if (!factorise()) {
      return OptimiseResult::Status::Singular;
    }
    const double before = cost_;
    if (!step(weighting) || decrease_ <= tolerance_ * before) {
      return OptimiseResult::Status::Converged;
    }
  }
  return OptimiseResult::Status::IterationLimit;
}

}  // namespace sketchloc::detail

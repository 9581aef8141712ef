#include "registration/plane_map.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kSmallestStepShare = 1e-4;

/// One damped step towards the target: halves the step until the error shrinks. Returns the share
/// of the Newton step taken, 0 if none helps.
double shrink_error(const PlaneMap& map, const Eigen::Vector2d& target,
                    const Eigen::Vector2d& newton_step, Inversion& best) {
  for (double share = 1.0; share > kSmallestStepShare; share *= 0.5) {
    const Eigen::Vector2d candidate = best.point + share * newton_step;
    const double error = (map(candidate).value - target).norm();
    if (error < best.error) {
      best.point = candidate;
      best.error = error;
      return share;
    }
  }
  return 0.0;
}

Inversion newton(const PlaneMap& map, const Eigen::Vector2d& target, const Eigen::Vector2d& start,
                 const InversionParams& params) {
  Inversion result{.point = start, .error = (map(start).value - target).norm()};
  for (int iteration = 0; iteration < params.max_iterations; ++iteration) {
    if (result.error <= params.tolerance) {
      break;
    }
    const PlaneMapPoint here = map(result.point);
    const double determinant = here.jacobian.determinant();
    if (!(std::abs(determinant) > 1e-12 * here.jacobian.squaredNorm())) {
      result.status = Inversion::Status::Singular;
      return result;
    }
    const Eigen::Vector2d newton_step = here.jacobian.inverse() * (target - here.value);
    if (shrink_error(map, target, newton_step, result) == 0.0) {
      break;
    }
  }
  if (result.error <= params.tolerance) {
    result.status = Inversion::Status::Converged;
  }
  return result;
}

}  // namespace

Inversion invert(const PlaneMap& map, const Eigen::Vector2d& target,
                 std::span<const Eigen::Vector2d> starts, const InversionParams& params) {
  check(!starts.empty(), "inverting a map needs a start");
  Inversion best{.error = std::numeric_limits<double>::infinity()};
  bool all_singular = true;
  for (const Eigen::Vector2d& start : starts) {
    const Inversion attempt = newton(map, target, start, params);
    if (attempt.status == Inversion::Status::Converged) {
      return attempt;
    }
    all_singular = all_singular && attempt.status == Inversion::Status::Singular;
    if (attempt.error < best.error) {
      best = attempt;
    }
  }
  best.status = all_singular ? Inversion::Status::Singular : Inversion::Status::IterationLimit;
  return best;
}

FoldReport find_folds(const PlaneMap& map, const PlaneBox& box, int samples_per_side) {
  check(samples_per_side >= 2, "a fold test needs 2 samples per side");
  FoldReport report{.min_determinant = std::numeric_limits<double>::infinity()};
  const double step_share = 1.0 / (samples_per_side - 1);
  for (int row = 0; row < samples_per_side; ++row) {
    for (int column = 0; column < samples_per_side; ++column) {
      const Eigen::Vector2d share(column * step_share, row * step_share);
      const Eigen::Vector2d point = box.low + share.cwiseProduct(box.size());
      const double determinant = map(point).jacobian.determinant();
      if (!(determinant >= report.min_determinant)) {  // NaN counts as a fold
        report.min_determinant = determinant;
        report.worst_point = point;
      }
      if (std::isnan(determinant)) {
        return report;
      }
    }
  }
  return report;
}

}  // namespace sketchloc

#include "registration/scan_matcher.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "motion/validate.hpp"
#include "registration/detail/point_to_line.hpp"

namespace sketchloc {
namespace {

/// The prior at one pose, as a quadratic that touches its cost there.
struct PriorPull {
  Eigen::Matrix3d information;
  Eigen::Vector3d half_gradient;
  double cost = 0.0;
};

/// Quadratic within about one sigma, linear beyond: wheels slip and stamps come late far more often
/// than a Gaussian allows, and yet a corridor must not pull the robot back by what it can see
/// twice.
PriorPull pull_of(const PosePrior& prior, const Se2& odom_from_robot) {
  const Eigen::Vector3d offset = (prior.odom_from_robot.inverse() * odom_from_robot).log();
  const double root = std::sqrt(1.0 + offset.dot(prior.information * offset));
  const Eigen::Matrix3d information = prior.information / root;
  return {information, information * offset, 2.0 * (root - 1.0)};
}

}  // namespace

void validate(const ScanMatchParams& params) {
  require_above("point_sigma_m", params.point_sigma_m, 0.0);
  require_in_range("independent_share", params.independent_share, 1e-6, 1.0);
  require_above("kernel_m", params.kernel_m, 0.0);
  require_at_least("min_points", params.min_points, 3.0);
  require_in_range("min_matched_share", params.min_matched_share, 0.0, 1.0);
  require_at_least("max_iterations", params.max_iterations, 1.0);
  require_above("stop_m", params.stop_m, 0.0);
}

ScanMatch match_scan(std::span<const SurfacePoint> points_in_robot, const SurfaceMap& map_in_odom,
                     const PosePrior& prior, const Se2& start_odom_from_robot,
                     const ScanMatchParams& params) {
  const double gain = params.independent_share / (params.point_sigma_m * params.point_sigma_m);
  ScanMatch match{.odom_from_robot = start_odom_from_robot};
  for (int iteration = 0; iteration < params.max_iterations; ++iteration) {
    const detail::PointToLine scan = detail::linearize_point_to_line(
        points_in_robot, map_in_odom, match.odom_from_robot, params.kernel_m);
    if (scan.partners < params.min_points) {
      match.status = ScanMatch::Status::TooFewPoints;
      return match;
    }
    const PriorPull pull = pull_of(prior, match.odom_from_robot);
    match.scan_information = gain * scan.information;
    match.matched_share =
        static_cast<double>(scan.close_partners) / static_cast<double>(points_in_robot.size());
    match.cost = gain * scan.cost + pull.cost;
    const Eigen::Vector3d step = -(match.scan_information + pull.information)
                                      .ldlt()
                                      .solve(gain * scan.half_gradient + pull.half_gradient);
    if (!step.allFinite()) {
      match.status = ScanMatch::Status::TooFewPoints;
      return match;
    }
    match.odom_from_robot = match.odom_from_robot * Se2::exp(step);
    if (step.cwiseAbs().maxCoeff() < params.stop_m) {
      match.status = ScanMatch::Status::Converged;
      return match;
    }
  }
  match.status = ScanMatch::Status::IterationLimit;
  return match;
}

}  // namespace sketchloc

#include "registration/scan_matcher.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// Gauss-Newton terms of all points at one pose, per unit of noise.
struct Linearization {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;
  int partners = 0;
  int close_partners = 0;
};

/// Geman-McClure with scale k: rho = r^2 / (1 + r^2 / k^2), weight = rho' / 2r.
Linearization linearize(std::span<const SurfacePoint> points_in_robot,
                        const SurfaceMap& map_in_odom, const Se2& odom_from_robot,
                        double kernel_m) {
  const Eigen::Matrix2d rotation = odom_from_robot.rotation_matrix();
  const double kernel_square = kernel_m * kernel_m;
  Linearization sum;
  for (const SurfacePoint& surface : points_in_robot) {
    const SurfacePoint in_odom{rotation * surface.point + odom_from_robot.translation(),
                               rotation * surface.normal};
    const SurfacePoint* partner = map_in_odom.nearest(in_odom);
    if (partner == nullptr) {
      sum.cost += kernel_square;
      continue;
    }
    const double residual_m = partner->normal.dot(in_odom.point - partner->point);
    const double shrink = 1.0 / (1.0 + residual_m * residual_m / kernel_square);
    const double weight = shrink * shrink;
    const Eigen::Vector2d normal_in_robot = rotation.transpose() * partner->normal;
    // Derivative for the step T exp(d): the point moves by (dx, dy) + dyaw (-y, x) in the robot.
    const Eigen::Vector3d jacobian(
        normal_in_robot.x(), normal_in_robot.y(),
        normal_in_robot.y() * surface.point.x() - normal_in_robot.x() * surface.point.y());
    sum.information += weight * jacobian * jacobian.transpose();
    sum.gradient += weight * residual_m * jacobian;
    sum.cost += residual_m * residual_m * shrink;
    ++sum.partners;
    sum.close_partners += std::abs(residual_m) < kernel_m ? 1 : 0;
  }
  return sum;
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
    const Linearization sum =
        linearize(points_in_robot, map_in_odom, match.odom_from_robot, params.kernel_m);
    const Eigen::Vector3d from_prior =
        (prior.odom_from_robot.inverse() * match.odom_from_robot).log();
    const double surprise = from_prior.dot(prior.information * from_prior);
    const Eigen::Matrix3d prior_information = prior.information / (1.0 + 0.5 * surprise);
    match.scan_information = gain * sum.information;
    match.matched_share = points_in_robot.empty() ? 0.0
                                                  : static_cast<double>(sum.close_partners) /
                                                        static_cast<double>(points_in_robot.size());
    match.cost = gain * sum.cost + 2.0 * std::log1p(0.5 * surprise);
    if (sum.partners < params.min_points) {
      match.status = ScanMatch::Status::TooFewPoints;
      return match;
    }
    const Eigen::Matrix3d information = match.scan_information + prior_information;
    const Eigen::Vector3d gradient = gain * sum.gradient + prior_information * from_prior;
    const Eigen::Vector3d step = -information.ldlt().solve(gradient);
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

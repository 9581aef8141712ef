#include "filter/pose_likelihood.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {

namespace {

constexpr double kNoIdea = 100.0;  ///< of a strain: more than any drawing has

/// The strain (axial, diagonal) of the warp's Jacobian at the robot: J J^T = scale^2 exp(2 strain).
/// None where it folds.
std::optional<Eigen::Vector2d> strain_of(const Warp& warp) {
  const std::optional<PlaneMapPoint> robot = warp.sketch_from_robot(Eigen::Vector2d::Zero());
  if (!robot || !(robot->jacobian.determinant() > 0.0)) {
    return std::nullopt;
  }
  const Eigen::Matrix2d square = robot->jacobian * robot->jacobian.transpose();
  const Eigen::Vector2d deviator(0.5 * (square(0, 0) - square(1, 1)), square(0, 1));
  const double size = deviator.norm();
  const double mean = 0.5 * square.trace();
  // exp of a traceless symmetric matrix of size 2 e: cosh 2e on the mean, sinh 2e along it.
  return size > 1e-12 ? Eigen::Vector2d(deviator / size * 0.5 * std::atanh(size / mean))
                      : Eigen::Vector2d::Zero();
}

/// The density of a right registration at the pose that it states, over that of a wrong one: the
/// room that it could have been found in, in units of its own covariance (m, m, rad, log scale).
double peak_of(const Eigen::Matrix4d& covariance, const PoseTrust& trust) {
  const double room = std::numbers::pi * trust.reach_m * trust.reach_m * 2.0 * trust.reach_rad *
                      2.0 * trust.reach_log_scale;
  const double own =
      4.0 * std::numbers::pi * std::numbers::pi * std::sqrt(covariance.determinant());
  return std::clamp(room / own, 1.0, trust.max_peak);
}

}  // namespace

void validate(const PoseTrust& trust) {
  require_above("inflation", trust.inflation, 0.0);
  require_above("reach_m", trust.reach_m, 0.0);
  require_above("reach_rad", trust.reach_rad, 0.0);
  require_above("reach_log_scale", trust.reach_log_scale, 0.0);
  require_at_least("max_peak", trust.max_peak, 1.0);
  require_in_range("max_probability", trust.max_probability, 1e-6, 1.0 - 1e-6);
  require_above("min_position_m", trust.min_position_m, 0.0);
  require_above("min_heading_rad", trust.min_heading_rad, 0.0);
  require_above("min_log_scale", trust.min_log_scale, 0.0);
  require_above("strain_sigma", trust.strain_sigma, 0.0);
}

PoseLikelihood pose_likelihood(const Registration& registration, const PoseTrust& trust,
                               double share) {
  check(registration.covariance.has_value(), "a registration that says how sure it is");
  check(share > 0.0 && share <= 1.0, "a share of the evidence");
  const Sim2& pose = registration.sketch_from_robot;
  const Eigen::Vector4d least(trust.min_position_m, trust.min_position_m, trust.min_heading_rad,
                              trust.min_log_scale);
  Eigen::Matrix4d covariance = *registration.covariance * (trust.inflation * trust.inflation);
  covariance.diagonal() += least.cwiseAbs2();
  covariance /= share;
  Eigen::Matrix4d sketch_from_error = Eigen::Matrix4d::Identity();
  sketch_from_error.topLeftCorner<2, 2>() = pose.scaled_rotation_matrix();
  const double probability = std::min(registration.inlier_probability, trust.max_probability);
  const std::optional<Eigen::Vector2d> strain = strain_of(registration.warp);
  return {.mean = {pose.x(), pose.y(), pose.yaw_rad(), std::log(pose.scale())},
          .covariance = sketch_from_error * covariance * sketch_from_error.transpose(),
          .strain = strain.value_or(Eigen::Vector2d::Zero()),
          .strain_sigma = strain ? trust.strain_sigma / std::sqrt(share) : kNoIdea,
          .outlier = 1.0 - probability,
          .inlier = probability * peak_of(covariance, trust)};
}

}  // namespace sketchloc

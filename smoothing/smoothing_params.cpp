#include "smoothing/smoothing_params.hpp"

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const DrawingWalk& walk) {
  require_above("length_m", walk.length_m, 0.0);
  require_above("shear_m", walk.shear_m, 0.0);
  require_above("heading_rad", walk.heading_rad, 0.0);
  require_above("log_scale", walk.log_scale, 0.0);
  require_at_least("turn_rad_per_rad", walk.turn_rad_per_rad, 0.0);
}

void validate(const SmoothingParams& params) {
  validate_part("walk", params.walk);
  require_above("start_position_m", params.start_position_m, 0.0);
  require_above("start_heading_rad", params.start_heading_rad, 0.0);
  require_above("start_log_scale", params.start_log_scale, 0.0);
  require_in_range("jump_log_odds", params.jump_log_odds, -1000.0, -1e-3);
  require_in_range("independent_share", params.independent_share, 1e-3, 1.0);
  require_in_range("max_probability", params.max_probability, 0.5, 1.0 - 1e-6);
  require_in_range("certainty", params.certainty, 1e-6, 1.0);
  require_above("lost_way_m", params.lost_way_m, 0.0);
  require_above("found_way_m", params.found_way_m, 0.0);
  require_in_range("start_elsewhere", params.start_elsewhere, 0.0, 1.0);
  require_above("min_position_m", params.min_position_m, 0.0);
  require_above("min_heading_rad", params.min_heading_rad, 0.0);
  require_above("min_log_scale", params.min_log_scale, 0.0);
  require_above("pair_position_m", params.pair_position_m, 0.0);
  require_above("pair_heading_rad", params.pair_heading_rad, 0.0);
  require_above("pair_log_scale", params.pair_log_scale, 0.0);
  require_at_least("pair_rounds", params.pair_rounds, 0.0);
  validate_part("kernel", params.kernel);
  require_no_graduation(params.kernel);
}

Eigen::Matrix4d start_covariance(const SmoothingParams& params) {
  return Eigen::Vector4d(params.start_position_m, params.start_position_m, params.start_heading_rad,
                         params.start_log_scale)
      .cwiseAbs2()
      .asDiagonal();
}

Eigen::Matrix4d pair_covariance(const SmoothingParams& params) {
  return Eigen::Vector4d(params.pair_position_m, params.pair_position_m, params.pair_heading_rad,
                         params.pair_log_scale)
      .cwiseAbs2()
      .asDiagonal();
}

Eigen::Matrix4d walk_covariance(const DrawingWalk& walk, double way_m, double turn_rad) {
  constexpr double kStandingM = 0.01;  // a robot that stands still is known this well, not exactly
  const double way_at_least_m = way_m + kStandingM;
  const double turn_sigma_rad = walk.turn_rad_per_rad * turn_rad;
  return Eigen::Vector4d(
             walk.length_m * walk.length_m * way_at_least_m,
             walk.shear_m * walk.shear_m * way_at_least_m,
             walk.heading_rad * walk.heading_rad * way_at_least_m + turn_sigma_rad * turn_sigma_rad,
             walk.log_scale * walk.log_scale * way_at_least_m)
      .asDiagonal();
}

}  // namespace sketchloc

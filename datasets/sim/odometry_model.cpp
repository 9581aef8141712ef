#include "datasets/sim/odometry_model.hpp"

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const OdometryModel& odometry) {
  require_in_range("length_bias_sigma", odometry.length_bias_sigma, 0.0, 0.3);
  require_in_range("turn_bias_sigma_rad_per_m", odometry.turn_bias_sigma_rad_per_m, 0.0, 1.0);
  require_in_range("turn_bias_sigma", odometry.turn_bias_sigma, 0.0, 0.3);
  validate(odometry.noise);
}

OdometrySimulator::OdometrySimulator(const OdometryModel& model, Rng& rng)
    : noise_(model.noise),
      length_factor_(1.0 + gaussian(model.length_bias_sigma, rng)),
      turn_rad_per_m_(gaussian(model.turn_bias_sigma_rad_per_m, rng)),
      turn_factor_(1.0 + gaussian(model.turn_bias_sigma, rng)) {}

Se2 OdometrySimulator::measured(const Se2& robot_from_next, Rng& rng) const {
  const Eigen::Vector2d way_m = length_factor_ * robot_from_next.translation();
  const double turn_rad = turn_factor_ * robot_from_next.yaw_rad() +
                          turn_rad_per_m_ * robot_from_next.translation().norm();
  return sample_increment(Se2::from_xy_yaw(way_m.x(), way_m.y(), turn_rad), noise_, rng);
}

}  // namespace sketchloc

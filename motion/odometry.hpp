#pragma once

#include "motion/random.hpp"
#include "motion/se2.hpp"

namespace sketchloc {

/// Noise of one odometry step, per component, 1-sigma. [Thrun05 5.4]
struct OdometryNoise {
  double slip_m_per_m = 0.05;      ///< translation error per metre driven, in [0, 1]
  double slip_m_per_rad = 0.01;    ///< translation error per radian turned, >= 0
  double turn_rad_per_m = 0.02;    ///< heading error per metre driven, >= 0
  double turn_rad_per_rad = 0.05;  ///< heading error per radian turned, >= 0
};

template <typename Visitor>
void visit_fields(OdometryNoise& noise, Visitor&& visit) {
  visit("slip_m_per_m", noise.slip_m_per_m);
  visit("slip_m_per_rad", noise.slip_m_per_rad);
  visit("turn_rad_per_m", noise.turn_rad_per_m);
  visit("turn_rad_per_rad", noise.turn_rad_per_rad);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const OdometryNoise& noise);

/// What the odometry says happened between two instants: `robot_from_next`.
Se2 odometry_increment(const Se2& odom_from_robot, const Se2& odom_from_next);

/// Standard deviations (x m, y m, yaw rad) of one increment in the robot frame.
Eigen::Vector3d increment_sigma(const Se2& robot_from_next, const OdometryNoise& noise);

/// The increment with noise drawn in its tangent space.
Se2 sample_increment(const Se2& robot_from_next, const OdometryNoise& noise, Rng& rng);

}  // namespace sketchloc

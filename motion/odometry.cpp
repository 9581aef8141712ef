#include "motion/odometry.hpp"

#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const OdometryNoise& noise) {
  require_in_range("slip_m_per_m", noise.slip_m_per_m, 0.0, 1.0);
  require_at_least("slip_m_per_rad", noise.slip_m_per_rad, 0.0);
  require_at_least("turn_rad_per_m", noise.turn_rad_per_m, 0.0);
  require_at_least("turn_rad_per_rad", noise.turn_rad_per_rad, 0.0);
}

Se2 odometry_increment(const Se2& odom_from_robot, const Se2& odom_from_next) {
  return odom_from_robot.inverse() * odom_from_next;
}

Eigen::Vector3d increment_sigma(const Se2& robot_from_next, const OdometryNoise& noise) {
  const double way_m = robot_from_next.translation().norm();
  const double turn_rad = std::abs(robot_from_next.yaw_rad());
  const double slip_m = std::hypot(noise.slip_m_per_m * way_m, noise.slip_m_per_rad * turn_rad);
  const double yaw_rad =
      std::hypot(noise.turn_rad_per_m * way_m, noise.turn_rad_per_rad * turn_rad);
  return {slip_m, slip_m, yaw_rad};
}

Se2 sample_increment(const Se2& robot_from_next, const OdometryNoise& noise, Rng& rng) {
  const Eigen::Vector3d sigma = increment_sigma(robot_from_next, noise);
  const double x = gaussian(sigma.x(), rng);
  const double y = gaussian(sigma.y(), rng);
  const double yaw = gaussian(sigma.z(), rng);
  return robot_from_next * Se2::exp({x, y, yaw});
}

}  // namespace sketchloc

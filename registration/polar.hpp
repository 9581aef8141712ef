#pragma once

#include <Eigen/Core>
#include <cmath>

namespace sketchloc {

/// Angle, in (-pi, pi], of the rotation in the polar decomposition of a Jacobian with det > 0: what
/// a local map does to headings.
inline double polar_yaw_rad(const Eigen::Matrix2d& jacobian) {
  return std::atan2(jacobian(1, 0) - jacobian(0, 1), jacobian(0, 0) + jacobian(1, 1));
}

}  // namespace sketchloc

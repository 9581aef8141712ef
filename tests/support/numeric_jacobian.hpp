#pragma once

#include <Eigen/Core>
#include <functional>

namespace sketchloc::testing {

/// Central differences of a map of the plane: the independent answer for a Jacobian.
inline Eigen::Matrix2d numeric_jacobian(
    const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& map, const Eigen::Vector2d& point,
    double step = 1e-5) {
  Eigen::Matrix2d jacobian;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d offset = step * Eigen::Vector2d::Unit(axis);
    jacobian.col(axis) = (map(point + offset) - map(point - offset)) / (2.0 * step);
  }
  return jacobian;
}

}  // namespace sketchloc::testing

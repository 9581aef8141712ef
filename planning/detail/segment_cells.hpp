#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "datasets/grid.hpp"

namespace sketchloc::detail {

inline constexpr double kBeyondCell_px = 1e-9;  ///< so far into the next cell, lest one stays

/// How far a unit direction goes from a point until it leaves the point's cell.
inline double to_next_cell_px(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) {
  double way_px = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double inside = point[axis] - std::floor(point[axis]);
    if (direction[axis] > 0.0) {
      way_px = std::min(way_px, (1.0 - inside) / direction[axis]);
    } else if (direction[axis] < 0.0) {
      way_px = std::min(way_px, -inside / direction[axis]);
    }
  }
  return std::max(way_px, 0.0) + kBeyondCell_px;
}

/// Calls visit(cell, way_px) for every cell that a segment touches, in order, with the length of
/// the part in it.
template <typename Visit>
void visit_cells(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Visit& visit) {
  const double length_px = (to - from).norm();
  if (length_px == 0.0) {
    visit(cell_at(from), 0.0);
    return;
  }
  const Eigen::Vector2d direction = (to - from) / length_px;
  for (double way_px = 0.0; way_px < length_px;) {
    const Eigen::Vector2d point = from + way_px * direction;
    const double step_px = to_next_cell_px(point, direction);
    visit(cell_at(point), std::min(step_px, length_px - way_px));
    way_px += step_px;
  }
}

}  // namespace sketchloc::detail

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "datasets/grid.hpp"

namespace sketchloc::detail {

inline constexpr double kBeyondCell_px = 1e-9;  ///< so far into the next cell, lest one stays

/// The cell that a point enters in a direction: on the edge between two cells the one ahead. By its
/// lower one alone, a point on an edge that is driven off by less than rounding would never leave.
inline Cell cell_ahead(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) {
  const auto ahead = [](double at, double towards) {
    return static_cast<int>(towards < 0.0 ? std::ceil(at) - 1.0 : std::floor(at));
  };
  return {ahead(point.x(), direction.x()), ahead(point.y(), direction.y())};
}

/// How far a unit direction goes from a point until it leaves the cell ahead.
inline double to_next_cell_px(const Eigen::Vector2d& point, const Eigen::Vector2d& direction) {
  const Cell cell = cell_ahead(point, direction);
  const Eigen::Vector2d low(cell.column, cell.row);
  double way_px = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] != 0.0) {
      const double edge = low[axis] + (direction[axis] > 0.0 ? 1.0 : 0.0);
      way_px = std::min(way_px, (edge - point[axis]) / direction[axis]);
    }
  }
  return way_px + kBeyondCell_px;
}

/// Calls visit(cell, way_px) for every cell that a segment runs through, in order, with the length
/// of the part in it.
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
    visit(cell_ahead(point, direction), std::min(step_px, length_px - way_px));
    way_px += step_px;
  }
}

}  // namespace sketchloc::detail

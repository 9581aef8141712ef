#include "tests/support/grid_traversal.hpp"

#include <cmath>
#include <limits>

namespace sketchloc::testing {
namespace {

double walk(const Grid<std::uint8_t>& occupied, const Eigen::Vector2d& origin, double heading_rad,
            double max_range, bool leave_own_stroke) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d direction(std::cos(heading_rad), std::sin(heading_rad));
  Cell cell = cell_at(origin);
  const int step_x = direction.x() < 0 ? -1 : 1;
  const int step_y = direction.y() < 0 ? -1 : 1;
  const double per_column = direction.x() == 0 ? kNever : 1.0 / std::abs(direction.x());
  const double per_row = direction.y() == 0 ? kNever : 1.0 / std::abs(direction.y());
  const double to_column = step_x > 0 ? cell.column + 1 - origin.x() : origin.x() - cell.column;
  const double to_row = step_y > 0 ? cell.row + 1 - origin.y() : origin.y() - cell.row;
  double next_column = direction.x() == 0 ? kNever : to_column * per_column;
  double next_row = direction.y() == 0 ? kNever : to_row * per_row;

  double distance = 0.0;
  while (occupied.contains(cell) && distance < max_range) {
    const bool in_stroke = occupied.row(cell.row)[static_cast<std::size_t>(cell.column)] != 0;
    if (in_stroke && !leave_own_stroke) {
      return distance;
    }
    leave_own_stroke = leave_own_stroke && in_stroke;
    if (next_column < next_row) {
      distance = next_column;
      next_column += per_column;
      cell.column += step_x;
    } else {
      distance = next_row;
      next_row += per_row;
      cell.row += step_y;
    }
  }
  return max_range;
}

}  // namespace

double traverse(const Grid<std::uint8_t>& occupied, const Eigen::Vector2d& origin,
                double heading_rad, double max_range) {
  return walk(occupied, origin, heading_rad, max_range, false);
}

double traverse_beyond_own_stroke(const Grid<std::uint8_t>& occupied, const Eigen::Vector2d& origin,
                                  double heading_rad, double max_range) {
  return walk(occupied, origin, heading_rad, max_range, true);
}

}  // namespace sketchloc::testing

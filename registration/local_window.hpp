#pragma once

#include "motion/sim2.hpp"

namespace sketchloc {

/// The square of the robot's plane that a registration looks at, cut into cells. Column 0 lies to
/// the back of the robot, row 0 to its right: a grid over it has x forward and y left, like the
/// robot frame.
struct LocalWindow {
  double side_m = 16.0;  ///< > 0
  int cells = 64;        ///< per side, >= 1
  double ahead_m = 0.0;  ///< the window's centre lies this far in front of the robot

  double cell_m() const { return side_m / cells; }

  /// Robot coordinates (m) to cell units, in which cell (0, 0) covers [0, 1) x [0, 1).
  Sim2 cells_from_robot() const {
    const double cells_per_m = cells / side_m;
    return Sim2::from_xy_yaw_scale(0.5 * cells - ahead_m * cells_per_m, 0.5 * cells, 0.0,
                                   cells_per_m);
  }
  Eigen::Vector2d centre_in_robot() const { return {ahead_m, 0.0}; }
};

template <typename Visitor>
void visit_fields(LocalWindow& window, Visitor&& visit) {
  visit("side_m", window.side_m);
  visit("cells", window.cells);
  visit("ahead_m", window.ahead_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const LocalWindow& window);

}  // namespace sketchloc

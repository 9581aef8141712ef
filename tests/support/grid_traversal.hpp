#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "datasets/grid.hpp"

namespace sketchloc::testing {

/// Oracle and baseline of every ray kernel: walks from cell to cell in double [Amanatides87] until
/// the first occupied one and gives the distance at which the ray enters it (0 from an occupied
/// cell, `max_range` where nothing is hit). The origin must be inside the grid.
double traverse(const Grid<std::uint8_t>& occupied, const Eigen::Vector2d& origin,
                double heading_rad, double max_range);

/// The same, but from within a stroke the ray first leaves it and goes on to the next one.
double traverse_beyond_own_stroke(const Grid<std::uint8_t>& occupied, const Eigen::Vector2d& origin,
                                  double heading_rad, double max_range);

}  // namespace sketchloc::testing

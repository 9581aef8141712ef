#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "datasets/grid.hpp"

namespace sketchloc {

/// Sets the cells whose centre lies within half the width of a line between two points in cell
/// units; also at width 0 the cells that the line's points fall into, so that no line has holes.
void paint_line(Grid<std::uint8_t>& cells, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                double width, std::uint8_t value = 1);

/// Paints all lines from one point to the next.
void paint_polyline(Grid<std::uint8_t>& cells, std::span<const Eigen::Vector2d> points,
                    double width, std::uint8_t value = 1);

/// Sets the cells whose centre lies in a convex polygon with counter-clockwise corners.
void paint_convex(Grid<std::uint8_t>& cells, std::span<const Eigen::Vector2d> corners,
                  std::uint8_t value = 1);

}  // namespace sketchloc

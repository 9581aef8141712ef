#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "datasets/grid.hpp"

namespace sketchloc::detail {

/// Thins a mask to lines one cell wide that keep its connections. [ZhangSuen84]
Grid<std::uint8_t> thin(Grid<std::uint8_t> mask);

/// Lines one cell wide as polylines through cell centres, cut where lines meet; loops come back to
/// their first point.
std::vector<std::vector<Eigen::Vector2d>> trace_lines(const Grid<std::uint8_t>& lines);

/// The fewest points of a polyline that stay within a tolerance of it. [DouglasPeucker73]
std::vector<Eigen::Vector2d> simplify(std::span<const Eigen::Vector2d> line, double tolerance);

}  // namespace sketchloc::detail

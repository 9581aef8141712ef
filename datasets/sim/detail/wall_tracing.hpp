#pragma once

#include <cstdint>
#include <vector>

#include "datasets/grid.hpp"
#include "datasets/sim/detail/polyline.hpp"

namespace sketchloc::detail {

/// Thins a mask to lines one cell wide that keep its connections. [ZhangSuen84]
Grid<std::uint8_t> thin(Grid<std::uint8_t> mask);

/// Lines one cell wide as polylines through cell centres, cut where lines meet; loops come back to
/// their first point.
std::vector<Polyline> trace_lines(const Grid<std::uint8_t>& lines);

}  // namespace sketchloc::detail

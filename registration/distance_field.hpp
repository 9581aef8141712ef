#pragma once

#include <cstdint>

#include "datasets/grid.hpp"

namespace sketchloc {

/// For every cell the Euclidean distance in px from its centre to the centre of the nearest
/// occupied cell (anything but zero); infinity where nothing is occupied. Exact, in time linear in
/// the cells [Meijster00]. Needs width^2 + height^2 < 2^31.
Grid<float> distance_field_px(const Grid<std::uint8_t>& occupied);

}  // namespace sketchloc

#pragma once

#include <cstdint>
#include <span>

#include "datasets/grid.hpp"

namespace sketchloc::detail {

/// Code of a range: round(log(range / min_range_px) / log_step) - 128, at most 126; 127 = nothing.
struct RangeScale {
  double min_range_px;
  double log_step;
};

/// Fills `codes` ([row][column][128 headings], cells of `cell_px` pixels) as RangeTable says.
///
/// For one heading, every line of that direction is walked from its far end: the range at a place
/// is the step to the next place plus the range there, or 0 in a stroke. Lines one pixel apart
/// cross the pixels of a column at the same places, so a whole column advances with the same few
/// vector instructions and stays exact.
void sweep_all_headings(const Grid<std::uint8_t>& occupied, const RangeScale& scale, int cell_px,
                        std::span<std::int8_t> codes);

}  // namespace sketchloc::detail

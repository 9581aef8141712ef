#pragma once

#include <cstdint>
#include <string>

#include "datasets/grid.hpp"
#include "eval/detail/run_picture.hpp"

namespace sketchloc::detail {

/// A part of a grey picture (row 0 at the bottom), magnified; white beyond its edge. Reduced, thin
/// dark lines stay visible.
Grid<std::uint8_t> zoomed(const Grid<std::uint8_t>& grey, const View& view, double zoom);

/// The bytes of a PNG file, reduced to at most `longest_px` along the longer side.
std::string encode_png(const Grid<std::uint8_t>& grey, int longest_px);

}  // namespace sketchloc::detail

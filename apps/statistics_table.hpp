#pragma once

#include <span>
#include <string>

#include "datasets/sim/drawing_statistics.hpp"

namespace sketchloc {

/// A Markdown table: each figure of a drawing as 5 %, median and 95 % over drawings (at least one).
std::string statistics_table(std::span<const DrawingStatistics> drawings);

}  // namespace sketchloc

#pragma once

#include <span>
#include <string>

#include "datasets/sim/drawing_statistics.hpp"
#include "datasets/sim/scan_agreement.hpp"

namespace sketchloc {

/// How a drawing distorts the world, and what that makes of the scans.
struct MeasuredDrawing {
  DrawingStatistics distortion;
  ScanAgreement agreement;
};

/// A Markdown table: each figure of a drawing as 5 %, median and 95 % over drawings (at least one).
std::string statistics_table(std::span<const MeasuredDrawing> drawings);

/// The same figures of the scans in a single drawing.
std::string agreement_table(const ScanAgreement& agreement);

}  // namespace sketchloc

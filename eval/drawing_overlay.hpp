#pragma once

#include <string>

#include "eval/run_record.hpp"

namespace sketchloc {

/// `overlay.png` of a run that was smoothed and has a spline: on the left the drawing with the
/// metric grid as it lies in it, on the right the drawing unbent into metres, with the end points
/// of the keyframes' scans along the metric trajectory and a scale. What the run does not tell is
/// left out: places whose 1-sigma is more than a metre. The bytes of a PNG file; checks that there
/// is a spline.
std::string overlay_png(const RunRecord& record);

}  // namespace sketchloc

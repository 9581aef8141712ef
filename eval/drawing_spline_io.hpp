#pragma once

#include <string>

#include "smoothing/drawing_spline.hpp"

namespace sketchloc {

/// The text of `spline.json`, see docs/formats.md; every number survives to the last bit.
std::string to_json(const DrawingSpline& spline, const KeyframeRun& run);

}  // namespace sketchloc

#pragma once

#include <string>

#include "eval/run_record.hpp"

namespace sketchloc {

/// `picture.png` of a run: the drawing with the estimated and the reference path, as the bytes of
/// a PNG file.
std::string picture_png(const RunRecord& record);

}  // namespace sketchloc

#pragma once

#include <opencv2/core.hpp>

#include "datasets/io/sketch_io.hpp"

namespace sketchloc::detail {

/// The ink of a line drawing: 255 on strokes, else 0. The picture has 8 bits and 1 or 3 channels.
/// The ground may vary slowly (a photo of paper in uneven light). Empty if there is no ink.
cv::Mat1b find_strokes(const cv::Mat& picture, const SketchReading& reading);

}  // namespace sketchloc::detail

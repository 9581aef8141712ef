#pragma once

#include <opencv2/core.hpp>

#include "datasets/io/sketch_io.hpp"

namespace sketchloc::detail {

/// The obstacles of a drawing in the image frame (row 0 on top): 255 where occupied, else 0.
struct Ink {
  cv::Mat1b occupied;
  Sketch::Kind kind = Sketch::Kind::Strokes;
};

/// Finds what a person drew in a picture of 8 bits with 1, 3 or 4 channels. An empty `occupied`
/// says that there is nothing drawn.
Ink find_ink(const cv::Mat& picture, const SketchReading& reading);

}  // namespace sketchloc::detail

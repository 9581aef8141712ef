#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "datasets/io/sketch_io.hpp"

namespace sketchloc::detail {

/// Free space that a person (or a mapper) painted in a picture.
struct PaintedArea {
  bool light = false;  ///< lighter than the ground, that is than most of the picture's border
};

/// The painted free space of a picture: lighter or darker than its ground, wide (not strokes) and
/// with sharp edges (not the shade on a photo). None if there is no such thing. A given polarity
/// says which of the two to look for.
std::optional<PaintedArea> find_painted_area(
    const cv::Mat1b& grey, const std::optional<SketchReading::Polarity>& polarity);

/// 255 for everything that is not as light (or dark) as the painted area itself.
cv::Mat1b obstacles_around(const PaintedArea& area, const cv::Mat1b& grey);

/// The lighter area if most of the picture's border is dark, else the darker one.
PaintedArea other_than_border(const cv::Mat1b& grey);

}  // namespace sketchloc::detail

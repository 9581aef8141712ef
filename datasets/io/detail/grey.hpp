#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace sketchloc::detail {

/// Brightness of a picture of 8 bits with 1 or 3 channels.
cv::Mat1b luminance(const cv::Mat& picture);

/// How many pixels have each level.
using Histogram = std::array<int, 256>;
Histogram histogram(const cv::Mat1b& grey);

/// 255 where the value is above the limit, else 0.
cv::Mat1b above(const cv::Mat1b& values, double limit);
/// 255 - value; of a mask, its complement.
cv::Mat1b inverted(const cv::Mat1b& values);
/// Grows a mask by a disc, in time that does not depend on the radius.
cv::Mat1b grown(const cv::Mat1b& mask, double radius_px);
/// What a mask keeps when a disc of that radius must fit into it (morphological opening).
cv::Mat1b opened(const cv::Mat1b& mask, double radius_px);

/// Grey levels between ink and ground, at least, for a person to see ink.
inline constexpr int kLeastContrast = 24;

}  // namespace sketchloc::detail

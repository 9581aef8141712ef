#include "datasets/io/detail/grey.hpp"

#include <opencv2/imgproc.hpp>

namespace sketchloc::detail {

cv::Mat1b luminance(const cv::Mat& picture) {
  if (picture.channels() == 1) {
    return picture;
  }
  cv::Mat1b grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

Histogram histogram(const cv::Mat1b& grey) {
  Histogram counts{};
  for (int row = 0; row < grey.rows; ++row) {
    const unsigned char* levels = grey.ptr(row);
    for (int column = 0; column < grey.cols; ++column) {
      ++counts[levels[column]];
    }
  }
  return counts;
}

cv::Mat1b above(const cv::Mat1b& values, double limit) {
  cv::Mat1b mask;
  cv::compare(values, limit, mask, cv::CMP_GT);
  return mask;
}

cv::Mat1b inverted(const cv::Mat1b& values) {
  cv::Mat1b out;
  cv::bitwise_not(values, out);
  return out;
}

cv::Mat1b grown(const cv::Mat1b& mask, double radius_px) {
  cv::Mat1f distance_px;
  cv::distanceTransform(inverted(mask), distance_px, cv::DIST_L2, cv::DIST_MASK_3, CV_32F);
  cv::Mat1b out;
  cv::compare(distance_px, radius_px, out, cv::CMP_LE);
  return out;
}

cv::Mat1b opened(const cv::Mat1b& mask, double radius_px) {
  if (cv::countNonZero(mask) == 0) {
    return mask;
  }
  const cv::Mat1b core = inverted(grown(inverted(mask), radius_px));
  return cv::countNonZero(core) == 0 ? core : grown(core, radius_px);
}

}  // namespace sketchloc::detail

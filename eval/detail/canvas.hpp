#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "eval/detail/run_picture.hpp"

namespace sketchloc::detail {

// Pictures for files, drawn with OpenCV: positions in px of the picture, y down.

constexpr Colour kText{29, 33, 39};

cv::Scalar bgr(const Colour& colour);

/// Where points of the drawing lie in the picture.
struct Frame {
  View view;
  double zoom = 1.0;

  cv::Point2d at(const Eigen::Vector2d& point_in_sketch) const {
    return {zoom * (point_in_sketch.x() - view.low.x()),
            zoom * (view.high.y() - point_in_sketch.y())};
  }
};

/// The drawing as it lies under what is drawn.
cv::Mat3b paper_image(const Sketch& sketch, const Frame& frame);

/// OpenCV draws at positions with so many fractional bits.
constexpr int kShift = 4;
cv::Point sub_pixel(const cv::Point2d& point);

using ImageLine = std::vector<cv::Point2d>;

/// A line in the look of a layer, `width_factor` times as wide.
void draw_line(cv::Mat3b& image, const ImageLine& line, const PathLayer& look, double width_factor);

void draw_layer(cv::Mat3b& image, const PathLayer& layer, const Frame& frame, double width_factor);

/// With a white edge; `at` is the lower left corner. OpenCV's letters are ASCII: others are left
/// out.
void write_text(cv::Mat3b& image, const std::string& text, const cv::Point& at, double size);

/// The bytes of a PNG file.
std::string png_bytes(const cv::Mat3b& image);

}  // namespace sketchloc::detail

#include "datasets/io/detail/ink.hpp"

#include <opencv2/imgproc.hpp>

#include "datasets/io/detail/grey.hpp"
#include "datasets/io/detail/painted_area.hpp"
#include "datasets/io/detail/strokes.hpp"

namespace sketchloc::detail {
namespace {

using Polarity = SketchReading::Polarity;

/// Puts a transparent drawing on paper of the other lightness than its ink.
cv::Mat without_alpha(const cv::Mat& picture, std::optional<Polarity> polarity) {
  if (picture.channels() != 4) {
    return picture;
  }
  cv::Mat3b out;
  cv::cvtColor(picture, out, cv::COLOR_BGRA2BGR);
  cv::Mat1b alpha;
  cv::extractChannel(picture, alpha, 3);
  const bool light_ink = polarity ? *polarity == Polarity::LightOnDark
                                  : cv::mean(luminance(out), above(alpha, 127))[0] > 127.0;
  const int ground = light_ink ? 0 : 255;
  for (int row = 0; row < out.rows; ++row) {
    for (int column = 0; column < out.cols; ++column) {
      const int opacity = alpha(row, column);
      for (int channel = 0; channel < 3; ++channel) {
        unsigned char& value = out(row, column)[channel];
        value = static_cast<unsigned char>((value * opacity + ground * (255 - opacity)) / 255);
      }
    }
  }
  return out;
}

std::optional<PaintedArea> painted_area(const cv::Mat1b& grey, const SketchReading& reading) {
  if (!reading.kind) {
    return find_painted_area(grey, reading.polarity);
  }
  if (*reading.kind == Sketch::Kind::Strokes) {
    return std::nullopt;
  }
  return reading.polarity ? PaintedArea{.light = *reading.polarity == Polarity::LightOnDark}
                          : other_than_border(grey);
}

}  // namespace

Ink find_ink(const cv::Mat& picture, const SketchReading& reading) {
  const cv::Mat opaque = without_alpha(picture, reading.polarity);
  const cv::Mat1b grey = luminance(opaque);
  Ink ink;
  if (const std::optional<PaintedArea> area = painted_area(grey, reading)) {
    ink = {.occupied = obstacles_around(*area, grey), .kind = Sketch::Kind::FilledFreeSpace};
  } else {
    ink = {.occupied = find_strokes(opaque, reading), .kind = Sketch::Kind::Strokes};
  }
  if (!ink.occupied.empty() && cv::countNonZero(ink.occupied) == 0) {
    ink.occupied.release();
  }
  return ink;
}

}  // namespace sketchloc::detail

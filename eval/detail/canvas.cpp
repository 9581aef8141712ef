#include "eval/detail/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "datasets/io/image_rows.hpp"
#include "eval/detail/raster.hpp"
#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

/// The part of a segment in [0, size] along one axis, as shares of its length; empty: low > high.
void cut(double from, double to, double size, double& low, double& high) {
  if (from == to) {
    high = from < 0.0 || from > size ? -1.0 : high;
    return;
  }
  const double at_zero = -from / (to - from);
  const double at_size = (size - from) / (to - from);
  low = std::max(low, std::min(at_zero, at_size));
  high = std::min(high, std::max(at_zero, at_size));
}

/// The parts of a line in the picture: OpenCV's positions have 32 bits, and dashes cost memory.
std::vector<ImageLine> inside(const ImageLine& line, const cv::Size& size) {
  std::vector<ImageLine> parts;
  bool goes_on = false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const cv::Point2d way = line[i] - line[i - 1];
    double low = 0.0;
    double high = 1.0;
    cut(line[i - 1].x, line[i].x, size.width, low, high);
    cut(line[i - 1].y, line[i].y, size.height, low, high);
    if (low > high) {
      goes_on = false;
      continue;
    }
    if (!goes_on || low > 0.0) {
      parts.push_back({line[i - 1] + low * way});
    }
    parts.back().push_back(line[i - 1] + high * way);
    goes_on = high == 1.0;
  }
  return parts;
}

/// The parts of a line that are drawn when every other `dash` of its length is left out.
std::vector<ImageLine> dashes(const ImageLine& line, double dash) {
  std::vector<ImageLine> parts = {{line.front()}};
  double left = dash;
  bool on = true;
  for (std::size_t i = 1; i < line.size(); ++i) {
    cv::Point2d from = line[i - 1];
    for (double length = cv::norm(line[i] - from); length > left; length -= left, left = dash) {
      from += (line[i] - from) * (left / length);
      if (on) {
        parts.back().push_back(from);
      } else {
        parts.push_back({from});
      }
      on = !on;
    }
    left -= cv::norm(line[i] - from);
    if (on) {
      parts.back().push_back(line[i]);
    }
  }
  return parts;
}

std::string ascii(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    const unsigned byte = static_cast<unsigned char>(c);
    if (byte < 0x80U) {
      plain += c;
    } else if (byte == 0xC2U) {  // leads the no-break space
      plain += ' ';
    }
  }
  return plain;
}

}  // namespace

cv::Mat3b paper_image(const Sketch& sketch, const Frame& frame) {
  cv::Mat3b image;
  cv::cvtColor(image_from_grid(zoomed(paper(sketch), frame.view, frame.zoom)), image,
               cv::COLOR_GRAY2BGR);
  return image;
}

cv::Scalar bgr(const Colour& colour) {
  return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
          static_cast<double>(colour.red)};
}

cv::Point sub_pixel(const cv::Point2d& point) {
  return {cvRound(std::ldexp(point.x, kShift)), cvRound(std::ldexp(point.y, kShift))};
}

void draw_line(cv::Mat3b& image, const ImageLine& line, const PathLayer& look,
               double width_factor) {
  constexpr double kDash_px = 9.0;
  const int width = std::max(1, cvRound(width_factor * look.width));
  const std::vector<ImageLine> parts =
      look.dashed ? dashes(line, kDash_px) : std::vector<ImageLine>(1, line);
  for (const ImageLine& part : parts) {
    std::vector<cv::Point> points;
    std::ranges::transform(part, std::back_inserter(points), sub_pixel);
    cv::polylines(image, points, false, bgr(look.colour), width, cv::LINE_AA, kShift);
  }
}

void draw_layer(cv::Mat3b& image, const PathLayer& layer, const Frame& frame, double width_factor) {
  for (const Polyline& polyline : layer.lines) {
    ImageLine line;
    std::ranges::transform(polyline, std::back_inserter(line),
                           [&](const Eigen::Vector2d& point) { return frame.at(point); });
    for (const ImageLine& part : inside(line, image.size())) {
      draw_line(image, part, layer, width_factor);
    }
  }
}

void write_text(cv::Mat3b& image, const std::string& text, const cv::Point& at, double size) {
  cv::putText(image, ascii(text), at, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, 5,
              cv::LINE_AA);
  cv::putText(image, ascii(text), at, cv::FONT_HERSHEY_SIMPLEX, size, bgr(kText), 1, cv::LINE_AA);
}

std::string png_bytes(const cv::Mat3b& image) {
  std::vector<std::uint8_t> bytes;
  check(cv::imencode(".png", image, bytes), "a picture can be encoded as PNG");
  return {bytes.begin(), bytes.end()};
}

}  // namespace sketchloc::detail

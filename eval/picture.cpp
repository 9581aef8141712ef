#include "eval/picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "datasets/io/image_rows.hpp"
#include "eval/detail/raster.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/detail/verdict.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

using detail::Colour;
using detail::PathLayer;
using detail::Polyline;
using detail::View;

constexpr double kLongest_px = 1600.0;
constexpr double kMostZoom = 6.0;
constexpr double kTextSize = 0.65;
constexpr double kWidthFactor = 1.6;  ///< of lines, from screen pixels to this picture's
constexpr Colour kText{29, 33, 39};

cv::Scalar bgr(const Colour& colour) {
  return {static_cast<double>(colour.blue), static_cast<double>(colour.green),
          static_cast<double>(colour.red)};
}

/// Where points of the drawing lie in the picture.
struct Frame {
  View view;
  double zoom = 1.0;

  cv::Point2d at(const Eigen::Vector2d& point_in_sketch) const {
    return {zoom * (point_in_sketch.x() - view.low.x()),
            zoom * (view.high.y() - point_in_sketch.y())};
  }
};

constexpr int kShift = 4;  ///< fractional bits of the positions that OpenCV draws at
cv::Point sub_pixel(const cv::Point2d& point) {
  return {cvRound(std::ldexp(point.x, kShift)), cvRound(std::ldexp(point.y, kShift))};
}

cv::Mat3b paper_image(const Sketch& sketch, const Frame& frame) {
  cv::Mat3b image;
  cv::cvtColor(image_from_grid(detail::zoomed(detail::paper(sketch), frame.view, frame.zoom)),
               image, cv::COLOR_GRAY2BGR);
  return image;
}

using ImageLine = std::vector<cv::Point2d>;

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

/// A line in pixels of the picture, in the look of a layer.
void draw_line(cv::Mat3b& image, const ImageLine& line, const PathLayer& look) {
  constexpr double kDash_px = 9.0;
  const int width = std::max(1, cvRound(kWidthFactor * look.width));
  const std::vector<ImageLine> parts =
      look.dashed ? dashes(line, kDash_px) : std::vector<ImageLine>(1, line);
  for (const ImageLine& part : parts) {
    std::vector<cv::Point> points;
    std::ranges::transform(part, std::back_inserter(points), sub_pixel);
    cv::polylines(image, points, false, bgr(look.colour), width, cv::LINE_AA, kShift);
  }
}

void draw_layer(cv::Mat3b& image, const PathLayer& layer, const Frame& frame) {
  for (const Polyline& polyline : layer.lines) {
    ImageLine line;
    std::ranges::transform(polyline, std::back_inserter(line),
                           [&](const Eigen::Vector2d& point) { return frame.at(point); });
    for (const ImageLine& part : inside(line, image.size())) {
      draw_line(image, part, layer);
    }
  }
}

/// OpenCV's letters are ASCII only.
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

void write_text(cv::Mat3b& image, const std::string& text, const cv::Point& at, double size) {
  cv::putText(image, ascii(text), at, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, 5,
              cv::LINE_AA);
  cv::putText(image, ascii(text), at, cv::FONT_HERSHEY_SIMPLEX, size, bgr(kText), 1, cv::LINE_AA);
}

void draw_ends(cv::Mat3b& image, const RunRecord& record, const Frame& frame) {
  constexpr int kRadius_px = 9;
  if (record.steps.empty()) {
    return;
  }
  const auto place_of = [&](const StepReport& report) {  // at the edge where it is outside
    const cv::Point2d place = frame.at(report.estimate.sketch_from_robot.translation());
    return cv::Point(cv::Point2d(std::clamp(place.x, 0.0, image.cols - 1.0),
                                 std::clamp(place.y, 0.0, image.rows - 1.0)));
  };
  const cv::Point start = place_of(record.steps.front());
  const cv::Point end = place_of(record.steps.back());
  cv::circle(image, start, kRadius_px, {255, 255, 255}, cv::FILLED, cv::LINE_AA);
  cv::circle(image, start, kRadius_px, bgr(kText), 3, cv::LINE_AA);
  const cv::Point corner(kRadius_px, kRadius_px);
  cv::rectangle(image, end - corner, end + corner, {255, 255, 255}, cv::FILLED);
  cv::rectangle(image, end - corner, end + corner, bgr(kText), 3, cv::LINE_AA);
  const cv::Point beside(kRadius_px + 8, kRadius_px - 2);
  write_text(image, "start", start + beside, kTextSize);
  write_text(image, "end", end + beside, kTextSize);
}

/// What the colours mean, from left to right.
void draw_legend(cv::Mat3b& image, std::span<const PathLayer> layers, const cv::Point& from) {
  constexpr int kSwatch_px = 36;
  constexpr int kGap_px = 30;
  cv::Point at = from;
  for (const PathLayer& layer : layers) {
    if (layer.name.empty() || layer.lines.empty()) {
      continue;
    }
    draw_line(image, {cv::Point2d(at), cv::Point2d(at.x + kSwatch_px, at.y)}, layer);
    at.x += kSwatch_px + 8;
    write_text(image, layer.name, at + cv::Point(0, 6), kTextSize);
    at.x += kGap_px +
            cv::getTextSize(layer.name, cv::FONT_HERSHEY_SIMPLEX, kTextSize, 1, nullptr).width;
  }
}

/// Title, verdict and legend, on white under the picture.
cv::Mat3b caption_image(const RunRecord& record, std::span<const PathLayer> layers, int width) {
  constexpr int kMargin_px = 14;
  constexpr int kLine_px = 34;
  cv::Mat3b image(2 * kLine_px + kMargin_px, width, cv::Vec3b(255, 255, 255));
  const SketchErrors errors = summarize_sketch_errors(step_errors(record), record.loss);
  const detail::Verdict verdict = detail::judge(errors, record.loss.bound_m);
  write_text(image, record.title + ". " + verdict.headline, {kMargin_px, kLine_px - 8}, kTextSize);
  draw_legend(image, layers, {kMargin_px, 2 * kLine_px - 10});
  return image;
}

}  // namespace

std::string picture_png(const RunRecord& record) {
  const std::vector<PathLayer> layers = detail::path_layers(record, step_errors(record));
  Frame frame{.view = detail::whole_view(record, layers)};
  frame.zoom = std::min(kMostZoom, kLongest_px / std::max(frame.view.width(), frame.view.height()));
  cv::Mat3b image = paper_image(record.sketch, frame);
  for (const PathLayer& layer : layers) {
    draw_layer(image, layer, frame);
  }
  draw_ends(image, record, frame);
  image.push_back(caption_image(record, layers, image.cols));
  std::vector<std::uint8_t> bytes;
  check(cv::imencode(".png", image, bytes), "a picture can be encoded as PNG");
  return {bytes.begin(), bytes.end()};
}

}  // namespace sketchloc

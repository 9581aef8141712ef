#include "eval/picture.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "eval/detail/canvas.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/detail/verdict.hpp"

namespace sketchloc {
namespace {

using detail::bgr;
using detail::draw_layer;
using detail::draw_line;
using detail::Frame;
using detail::kText;
using detail::PathLayer;
using detail::write_text;

constexpr double kLongest_px = 1600.0;
constexpr double kMostZoom = 6.0;
constexpr double kTextSize = 0.65;
constexpr double kWidthFactor = 1.6;  ///< of lines, from screen pixels to this picture's

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
    draw_line(image, {cv::Point2d(at), cv::Point2d(at.x + kSwatch_px, at.y)}, layer, kWidthFactor);
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
  cv::Mat3b image = detail::paper_image(record.sketch, frame);
  for (const PathLayer& layer : layers) {
    draw_layer(image, layer, frame, kWidthFactor);
  }
  draw_ends(image, record, frame);
  image.push_back(caption_image(record, layers, image.cols));
  return detail::png_bytes(image);
}

}  // namespace sketchloc

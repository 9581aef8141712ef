#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "eval/detail/canvas.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/plan_record.hpp"

namespace sketchloc {
namespace {

using detail::Colour;
using detail::Frame;
using detail::PathLayer;

constexpr int kLongestSide_px = 1400;
constexpr double kDiscEvery_m = 1.0;
constexpr Colour kInk{60, 60, 66};
constexpr Colour kBlocked{236, 236, 240};
constexpr Colour kDisc{205, 225, 245};

cv::Vec3b bgr_of(const Colour& colour) { return {colour.blue, colour.green, colour.red}; }

/// Strokes, and paler where the robot does not fit.
cv::Mat3b ground(const PlanRecord& record, double zoom) {
  const Sketch& sketch = record.sketch;
  cv::Mat3b image(sketch.height_px(), sketch.width_px(), cv::Vec3b(255, 255, 255));
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const Cell cell{column, image.rows - 1 - row};
      if (sketch.occupied.at(cell) != 0) {
        image(row, column) = bgr_of(kInk);
      } else if (!record.space.is_free(cell)) {
        image(row, column) = bgr_of(kBlocked);
      }
    }
  }
  cv::Mat3b zoomed;
  cv::resize(image, zoomed, {}, zoom, zoom, zoom < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
  return zoomed;
}

/// Points of the way a px apart.
detail::Polyline dense(const PathPoints& path) {
  detail::Polyline points;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d side = path[i] - path[i - 1];
    const int parts = std::max(1, static_cast<int>(side.norm()));
    for (int part = 0; part < parts; ++part) {
      points.push_back(path[i - 1] + side * (static_cast<double>(part) / parts));
    }
  }
  if (!path.empty()) {
    points.push_back(path.back());
  }
  return points;
}

Colour colour_at(const PlanRecord& record, const Eigen::Vector2d& point) {
  if (record.space.is_crossing(point)) {
    return detail::kBad;
  }
  const bool roomy = record.space.clearance_m(point) >= 2.0 * record.params.body.clear_m();
  return roomy ? detail::kGood : detail::kFair;
}

void draw_discs(cv::Mat3b& image, const PlanRecord& record, const detail::Polyline& points,
                const Frame& frame) {
  double way_m = kDiscEvery_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    way_m += i == 0 ? 0.0 : record.space.length_m(points[i - 1], points[i]);
    if (way_m < kDiscEvery_m) {
      continue;
    }
    way_m = 0.0;
    const double radius_px =
        frame.zoom * record.params.body.clear_m() * record.space.px_per_m(points[i]);
    cv::circle(image, detail::sub_pixel(frame.at(points[i])),
               cvRound(std::ldexp(radius_px, detail::kShift)), detail::bgr(kDisc), cv::FILLED,
               cv::LINE_AA, detail::kShift);
  }
}

void draw_way(cv::Mat3b& image, const PlanRecord& record, const detail::Polyline& points,
              const Frame& frame) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PathLayer layer{
        .name = "", .colour = colour_at(record, points[i]), .lines = {{points[i - 1], points[i]}}};
    draw_layer(image, layer, frame, 1.5);
  }
}

void mark(cv::Mat3b& image, const Eigen::Vector2d& point, const std::string& name,
          const Frame& frame) {
  const cv::Point2d at = frame.at(point);
  cv::circle(image, detail::sub_pixel(at), cvRound(std::ldexp(6.0, detail::kShift)),
             detail::bgr(detail::kReferenceBlue), 3, cv::LINE_AA, detail::kShift);
  detail::write_text(image, name, cv::Point(cvRound(at.x) + 10, cvRound(at.y) - 8), 0.55);
}

}  // namespace

std::string picture_png(const PlanRecord& record) {
  const int longest_px = std::max({record.sketch.width_px(), record.sketch.height_px(), 1});
  const double zoom = static_cast<double>(kLongestSide_px) / longest_px;
  const Frame frame{
      .view = {.low = Eigen::Vector2d::Zero(),
               .high = Eigen::Vector2d(record.sketch.width_px(), record.sketch.height_px())},
      .zoom = zoom};
  cv::Mat3b image = ground(record, zoom);
  const detail::Polyline points = dense(record.plan.path_in_sketch);
  draw_discs(image, record, points, frame);
  draw_way(image, record, points, frame);
  mark(image, record.query.start_in_sketch, "start", frame);
  mark(image, record.query.goal_in_sketch, "goal", frame);
  if (const auto& nearest = record.plan.nearest_free_in_sketch) {
    mark(image, *nearest, "fits here", frame);
  }
  return detail::png_bytes(image);
}

}  // namespace sketchloc

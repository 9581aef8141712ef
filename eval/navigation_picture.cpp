#include "eval/navigation_picture.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "eval/detail/canvas.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"

namespace sketchloc {
namespace {

using detail::Frame;
using detail::PathLayer;

constexpr int kPanel_px = 900;

/// Cells in black and white, the whole of them in a panel.
cv::Mat3b panel_of(const Grid<std::uint8_t>& occupied) {
  cv::Mat3b image(occupied.height(), occupied.width(), cv::Vec3b(255, 255, 255));
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      if (occupied.at({column, image.rows - 1 - row}) != 0) {
        image(row, column) = {90, 80, 80};
      }
    }
  }
  const double zoom = static_cast<double>(kPanel_px) / std::max(image.rows, image.cols);
  cv::resize(image, image, {}, zoom, zoom, zoom < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
  cv::Mat3b panel(kPanel_px, kPanel_px, cv::Vec3b(255, 255, 255));
  image.copyTo(panel(cv::Rect(0, 0, image.cols, image.rows)));
  return panel;
}

/// Of what a panel shows, from its upper edge on.
int height_of(const Grid<std::uint8_t>& occupied) {
  const double zoom =
      static_cast<double>(kPanel_px) / std::max(occupied.width(), occupied.height());
  return std::min(kPanel_px, cvCeil(zoom * occupied.height()));
}

Frame frame_of(const Grid<std::uint8_t>& occupied) {
  return {.view = {.low = Eigen::Vector2d::Zero(),
                   .high = Eigen::Vector2d(occupied.width(), occupied.height())},
          .zoom = static_cast<double>(kPanel_px) / std::max(occupied.width(), occupied.height())};
}

void mark(cv::Mat3b& image, const cv::Point2d& at, const std::string& name) {
  cv::circle(image, detail::sub_pixel(at), cvRound(std::ldexp(6.0, detail::kShift)),
             detail::bgr(detail::kReferenceBlue), 3, cv::LINE_AA, detail::kShift);
  constexpr double kScale = 0.55;
  const cv::Size size = cv::getTextSize(name, cv::FONT_HERSHEY_SIMPLEX, kScale, 1, nullptr);
  const cv::Point text(std::clamp(cvRound(at.x) + 10, 0, std::max(0, image.cols - size.width - 4)),
                       std::max(cvRound(at.y) - 8, size.height + 4));
  detail::write_text(image, name, text, kScale);
}

}  // namespace

std::string picture_png(const NavigationTask& task, const NavigationTrial& trial) {
  const Grid<std::uint8_t>& drawn = task.drawing.sketch.occupied;
  const MetricMap& map = task.building.map;
  cv::Mat3b left = panel_of(drawn);
  cv::Mat3b right = panel_of(map.cells);
  PathLayer planned{.name = "", .colour = detail::kGrey, .width = 1.0, .dashed = true};
  PathLayer believed{.name = "", .colour = detail::kGood};
  PathLayer driven{.name = "", .colour = detail::kGood};
  planned.lines = {trial.paths_in_sketch.front()};
  believed.lines.emplace_back();
  driven.lines.emplace_back();
  for (const NavigationFrame& frame : trial.frames) {
    believed.lines.front().push_back(frame.sketch_from_robot.translation());
    driven.lines.front().push_back(map.cells_from_world(frame.world_from_robot.translation()));
  }
  draw_layer(left, planned, frame_of(drawn), 1.5);
  draw_layer(left, believed, frame_of(drawn), 1.5);
  draw_layer(right, driven, frame_of(map.cells), 1.5);
  mark(left, frame_of(drawn).at(task.drawing.sketch_from_world(task.goal_in_world)), "goal");
  mark(right, frame_of(map.cells).at(map.cells_from_world(task.goal_in_world)), "goal");
  mark(right, frame_of(map.cells).at(map.cells_from_world(task.world_from_start.translation())),
       "start");
  cv::Mat3b whole;
  cv::hconcat(left, right, whole);
  const int height_px = std::max(height_of(drawn), height_of(map.cells));
  return detail::png_bytes(whole.rowRange(0, height_px));
}

}  // namespace sketchloc

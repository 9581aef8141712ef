#include "eval/drawing_overlay.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "eval/detail/canvas.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/detail/text.hpp"
#include "motion/check.hpp"
#include "registration/plane_map.hpp"
#include "registration/polar.hpp"

namespace sketchloc {
namespace {

using detail::bgr;
using detail::Frame;
using detail::PathLayer;
using detail::Polyline;

constexpr double kPanel_px = 900.0;
constexpr int kCaption_px = 40;
constexpr double kWorst_m = 1.0;      ///< 1-sigma of what is shown
constexpr double kSigmaCell_m = 0.5;  ///< between places where that is asked
constexpr double kTextSize = 0.6;
constexpr detail::Colour kGridColour{0, 100, 190};
constexpr detail::Colour kScanColour{0, 158, 115};
constexpr detail::Colour kWayColour{213, 68, 0};

/// Where the spline is known well enough, on a lattice over the control points.
class KnownArea {
 public:
  explicit KnownArea(const DrawingSpline& spline) {
    box_.low = box_.high = spline.basis.control_points().front();
    for (const Eigen::Vector2d& point : spline.basis.control_points()) {
      box_.low = box_.low.cwiseMin(point);
      box_.high = box_.high.cwiseMax(point);
    }
    const Eigen::Array2i cells = (box_.size() / kSigmaCell_m).array().ceil().cast<int>() + 1;
    known_ = Grid<std::uint8_t>(cells.x(), cells.y(), 0);
    for (int row = 0; row < cells.y(); ++row) {
      for (int column = 0; column < cells.x(); ++column) {
        const Eigen::Vector2d point = box_.low + kSigmaCell_m * Eigen::Vector2d(column, row);
        known_.row(row)[static_cast<std::size_t>(column)] =
            spline.sigma_m(point) <= kWorst_m &&
                    spline.sketch_from_metric.jacobian(point).determinant() > 0.0
                ? 1
                : 0;
      }
    }
  }

  bool contains(const Eigen::Vector2d& point) const {
    const Eigen::Array2i cell = ((point - box_.low) / kSigmaCell_m).array().round().cast<int>();
    return (cell >= 0).all() && cell.x() < known_.width() && cell.y() < known_.height() &&
           known_.row(cell.y())[static_cast<std::size_t>(cell.x())] != 0;
  }

  /// The smallest box with all that is known and the way.
  PlaneBox box_around(const std::vector<Se2>& way) const {
    PlaneBox box{.low = way.front().translation(), .high = way.front().translation()};
    const auto extend = [&](const Eigen::Vector2d& point) {
      box.low = box.low.cwiseMin(point);
      box.high = box.high.cwiseMax(point);
    };
    for (const Se2& pose : way) {
      extend(pose.translation());
    }
    for (int row = 0; row < known_.height(); ++row) {
      for (int column = 0; column < known_.width(); ++column) {
        if (known_.row(row)[static_cast<std::size_t>(column)] != 0) {
          extend(box_.low + kSigmaCell_m * Eigen::Vector2d(column, row));
        }
      }
    }
    return box;
  }

 private:
  PlaneBox box_;
  Grid<std::uint8_t> known_;
};

/// The same in a metric frame that is turned as the drawing is: both pictures have one side up.
DrawingSpline turned_as_drawn(const DrawingSpline& spline) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Se2& pose : spline.metric_from_robot) {
    sum += spline.sketch_from_metric.jacobian(pose.translation());
  }
  const Se2 turn = Se2::from_xy_yaw(0.0, 0.0, polar_yaw_rad(sum));
  std::vector<Eigen::Vector2d> controls;
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& control : spline.basis.control_points()) {
    controls.push_back(turn * control);
    places.push_back(spline.sketch_from_metric(control));
  }
  DrawingSpline turned = spline;
  turned.sketch_from_metric = TpsSolver::factor(controls)->solve(places);
  turned.basis = *SplineBasis::over(controls);
  for (Se2& pose : turned.metric_from_robot) {
    pose = turn * pose;
  }
  return turned;
}

/// 1, 2, 5 or 10 m: about eight of them over the picture.
double grid_spacing_m(const PlaneBox& box) {
  const double wanted = box.size().maxCoeff() / 8.0;
  return wanted < 1.5 ? 1.0 : wanted < 3.5 ? 2.0 : wanted < 7.5 ? 5.0 : 10.0;
}

/// The lines of the metric grid where it is known, as points of the metric frame.
std::vector<Polyline> grid_lines(const PlaneBox& box, double spacing_m, const KnownArea& known) {
  constexpr double kStep_m = 0.25;
  std::vector<Polyline> lines;
  for (const int axis : {0, 1}) {
    const double first = std::ceil(box.low[axis] / spacing_m) * spacing_m;
    for (double at = first; at <= box.high[axis]; at += spacing_m) {
      lines.emplace_back();
      for (double along = box.low[1 - axis]; along <= box.high[1 - axis]; along += kStep_m) {
        Eigen::Vector2d point;
        point[axis] = at;
        point[1 - axis] = along;
        if (known.contains(point)) {
          lines.back().push_back(point);
        } else if (!lines.back().empty()) {
          lines.emplace_back();
        }
      }
    }
  }
  return lines;
}

std::vector<Polyline> in_sketch(std::vector<Polyline> lines, const ThinPlateSpline& spline) {
  for (Polyline& line : lines) {
    for (Eigen::Vector2d& point : line) {
      point = spline(point);
    }
  }
  return lines;
}

Polyline way_of(const DrawingSpline& spline) {
  Polyline way;
  for (const Se2& pose : spline.metric_from_robot) {
    way.push_back(pose.translation());
  }
  return way;
}

/// A frame as wide or as high as a panel.
Frame frame_of(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double most_zoom) {
  const double margin = 0.02 * (high - low).maxCoeff();
  Frame frame{.view = {.low = low.array() - margin, .high = high.array() + margin}};
  frame.zoom = std::min(most_zoom, kPanel_px / std::max(frame.view.width(), frame.view.height()));
  return frame;
}

std::string metres(double length_m) { return detail::fixed(length_m, 0).append(" m"); }

cv::Mat3b blank(const Frame& frame) {
  const int rows = std::max(1, static_cast<int>(std::ceil(frame.zoom * frame.view.height())));
  const int columns = std::max(1, static_cast<int>(std::ceil(frame.zoom * frame.view.width())));
  return cv::Mat3b(rows, columns, cv::Vec3b(255, 255, 255));
}

/// Ink, paper or nothing at a place of the drawing and `reach_px` around it.
std::uint8_t shade(const Grid<std::uint8_t>& paper, const Eigen::Vector2d& place, int reach_px) {
  const int column = static_cast<int>(std::floor(place.x()));
  const int row = static_cast<int>(std::floor(place.y()));
  std::uint8_t darkest = 255;
  for (int y = std::max(0, row - reach_px); y <= std::min(paper.height() - 1, row + reach_px);
       ++y) {
    for (int x = std::max(0, column - reach_px);
         x <= std::min(paper.width() - 1, column + reach_px); ++x) {
      darkest = std::min(darkest, paper.row(y)[static_cast<std::size_t>(x)]);
    }
  }
  return darkest;
}

/// The drawing in metres: what lies under each pixel; grey where nothing is known.
cv::Mat3b unbent(const Sketch& sketch, const DrawingSpline& spline, const KnownArea& known,
                 const Frame& frame) {
  constexpr std::uint8_t kUnknown = 235;
  const Grid<std::uint8_t> paper = detail::paper(sketch, 60);
  cv::Mat3b image = blank(frame);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const Eigen::Vector2d point(frame.view.low.x() + (column + 0.5) / frame.zoom,
                                  frame.view.high.y() - (row + 0.5) / frame.zoom);
      std::uint8_t grey = kUnknown;
      if (known.contains(point)) {
        const PlaneMapPoint map = spline.sketch_from_metric.at(point);
        const double px = std::sqrt(std::max(0.0, map.jacobian.determinant())) / frame.zoom;
        grey = shade(paper, map.value, static_cast<int>(std::floor(0.5 * px)));
      }
      image(row, column) = cv::Vec3b(grey, grey, grey);
    }
  }
  return image;
}

void draw_scans(cv::Mat3b& image, const RunRecord& record, const DrawingSpline& spline,
                const Frame& frame) {
  const auto& keyframes = record.keyframes.keyframes;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    if (keyframes[k].step >= record.run.steps.size()) {
      continue;
    }
    for (const Eigen::Vector2d& point :
         end_points_in_robot(record.run.steps[keyframes[k].step].scan)) {
      const cv::Point2d at = frame.at(spline.metric_from_robot[k] * point);
      if (at.x >= 0 && at.y >= 0 && at.x < image.cols && at.y < image.rows) {
        cv::circle(image, cv::Point(at), 1, bgr(kScanColour), cv::FILLED);
      }
    }
  }
}

void draw_scale(cv::Mat3b& image, double spacing_m, const Frame& frame) {
  constexpr int kMargin_px = 24;
  const int length = static_cast<int>(spacing_m * frame.zoom);
  const cv::Point left(kMargin_px, image.rows - kMargin_px);
  cv::line(image, left, left + cv::Point(length, 0), bgr(detail::kText), 3);
  detail::write_text(image, metres(spacing_m), left + cv::Point(0, -8), kTextSize);
}

cv::Mat3b captioned(cv::Mat3b image, int height, const std::string& caption) {
  cv::Mat3b panel(height + kCaption_px, std::max(image.cols, 560), cv::Vec3b(255, 255, 255));
  image.copyTo(panel(cv::Rect(0, 0, image.cols, image.rows)));
  detail::write_text(panel, caption, {14, height + kCaption_px - 14}, kTextSize);
  return panel;
}

}  // namespace

std::string overlay_png(const RunRecord& record) {
  check(record.spline.has_value(), "an overlay needs a spline");
  constexpr double kMostSketchZoom = 4.0;
  constexpr double kMostPxPerM = 60.0;
  const DrawingSpline spline = turned_as_drawn(*record.spline);
  const KnownArea known(spline);
  const PlaneBox box = known.box_around(spline.metric_from_robot);
  const double spacing_m = grid_spacing_m(box);
  PathLayer grid{
      .name = {}, .colour = kGridColour, .width = 0.7, .lines = grid_lines(box, spacing_m, known)};
  PathLayer way{.name = {}, .colour = kWayColour, .width = 1.5, .lines = {way_of(spline)}};

  const Frame metric = frame_of(box.low, box.high, kMostPxPerM);
  cv::Mat3b right = unbent(record.sketch, spline, known, metric);
  draw_layer(right, grid, metric, 1.0);
  draw_scans(right, record, spline, metric);
  draw_layer(right, way, metric, 1.0);
  draw_scale(right, spacing_m, metric);

  const detail::View content = detail::whole_view(record, {});
  const Frame drawn = frame_of(content.low, content.high, kMostSketchZoom);
  cv::Mat3b left = detail::paper_image(record.sketch, drawn);
  grid.lines = in_sketch(grid.lines, spline.sketch_from_metric);
  way.lines = in_sketch(way.lines, spline.sketch_from_metric);
  draw_layer(left, grid, drawn, 1.0);
  draw_layer(left, way, drawn, 1.0);

  const int height = std::max(left.rows, right.rows);
  left = captioned(left, height,
                   std::string("The drawing; blue: a grid of ").append(metres(spacing_m)));
  right = captioned(right, height, "Unbent into metres; green: what the scans saw, red: the way");
  cv::Mat3b both;
  cv::hconcat(left, right, both);
  return detail::png_bytes(both);
}

}  // namespace sketchloc

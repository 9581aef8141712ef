#include "registration/sketch_crop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "motion/check.hpp"
#include "registration/distance_field.hpp"
#include "registration/scan_raster.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kBeams = 360;  ///< of the scan that the drawing lets expect

/// The box of whole pixels that holds the window and a pixel more.
struct PixelBox {
  Cell low;
  Cell high;
};

PixelBox box_around(const Sim2& sketch_from_cells, int cells, int width, int height) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const double x : {-1.0, cells + 1.0}) {
    for (const double y : {-1.0, cells + 1.0}) {
      const Eigen::Vector2d corner = sketch_from_cells * Eigen::Vector2d(x, y);
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  const auto clip = [](double value, int limit) {
    return static_cast<int>(std::clamp(std::floor(value), -1.0, static_cast<double>(limit)));
  };
  return {{clip(low.x() - 1.0, width), clip(low.y() - 1.0, height)},
          {clip(high.x() + 1.0, width), clip(high.y() + 1.0, height)}};
}

/// The occupied pixels with a free one beside them.
Grid<std::uint8_t> outline_of(const Grid<std::uint8_t>& occupied) {
  Grid<std::uint8_t> outline(occupied.width(), occupied.height());
  const auto is_free = [&](int column, int row) {
    return occupied.contains({column, row}) && occupied.at({column, row}) == 0;
  };
  for (int row = 0; row < occupied.height(); ++row) {
    for (int column = 0; column < occupied.width(); ++column) {
      const bool beside_free = is_free(column - 1, row) || is_free(column + 1, row) ||
                               is_free(column, row - 1) || is_free(column, row + 1);
      outline.at({column, row}) = occupied.at({column, row}) != 0 && beside_free ? 1 : 0;
    }
  }
  return outline;
}

}  // namespace

SketchCropper::SketchCropper(const Sketch& sketch)
    : SketchCropper(sketch.kind == Sketch::Kind::FilledFreeSpace ? outline_of(sketch.occupied)
                                                                 : sketch.occupied) {}

SketchCropper::SketchCropper(const Grid<std::uint8_t>& occupied)
    : distance_px_(distance_field_px(occupied)), caster_(occupied) {
  check(!occupied.empty(), "a drawing has pixels");
  for (int row = 0; row < occupied.height(); ++row) {
    row_starts_.push_back(ink_columns_.size());
    for (int column = 0; column < occupied.width(); ++column) {
      if (occupied.row(row)[static_cast<std::size_t>(column)] != 0) {
        ink_columns_.push_back(column);
      }
    }
  }
  row_starts_.push_back(ink_columns_.size());
}

/// Calls visit(point in cell units, area in px) for the ink in and around the window. Pixels larger
/// than a cell come in parts, so that no cell is missed.
template <typename Visit>
void SketchCropper::for_each_ink(const Sim2& cells_from_sketch, int cells, Visit&& visit) const {
  const PixelBox box =
      box_around(cells_from_sketch.inverse(), cells, distance_px_.width(), distance_px_.height());
  const int parts = std::max(1, static_cast<int>(std::ceil(cells_from_sketch.scale())));
  const float part_px = 1.0F / static_cast<float>(parts);
  const Eigen::Matrix2f linear = cells_from_sketch.scaled_rotation_matrix().cast<float>();
  const Eigen::Vector2f shift = cells_from_sketch.translation().cast<float>();
  for (int row = std::max(0, box.low.row); row <= box.high.row && row < distance_px_.height();
       ++row) {
    const auto at = [&](std::size_t index) {
      return ink_columns_.begin() + static_cast<std::ptrdiff_t>(index);
    };
    const auto end = at(row_starts_[static_cast<std::size_t>(row) + 1]);
    auto ink =
        std::lower_bound(at(row_starts_[static_cast<std::size_t>(row)]), end, box.low.column);
    for (; ink != end && *ink <= box.high.column; ++ink) {
      for (int part = 0; part < parts * parts; ++part) {
        const Eigen::Vector2f point(
            static_cast<float>(*ink) + part_px * (static_cast<float>(part % parts) + 0.5F),
            static_cast<float>(row) + part_px * (static_cast<float>(part / parts) + 0.5F));
        visit(Eigen::Vector2f(linear * point + shift), part_px * part_px);
      }
    }
  }
}

Grid<float> SketchCropper::strokes(const Sim2& cells_from_sketch, int cells) const {
  // One cell of margin takes what falls beside the window without a test.
  const int stride = cells + 2;
  std::vector<float> area_px(static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride));
  const auto limit = static_cast<float>(cells);
  for_each_ink(cells_from_sketch, cells, [&](const Eigen::Vector2f& point, float area) {
    const float x = point.x() + 0.5F;
    const float y = point.y() + 0.5F;
    if (!(x >= 0.0F && y >= 0.0F && x < limit + 1.0F && y < limit + 1.0F)) {
      return;
    }
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float u = x - static_cast<float>(column);
    const float v = y - static_cast<float>(row);
    float* cell = area_px.data() + row * stride + column;
    cell[0] += area * (1.0F - u) * (1.0F - v);
    cell[1] += area * u * (1.0F - v);
    cell[stride] += area * (1.0F - u) * v;
    cell[stride + 1] += area * u * v;
  });
  const double cells_per_px = cells_from_sketch.scale();
  const auto per_line = static_cast<float>(cells_per_px * std::max(1.0, cells_per_px));
  Grid<float> strokes(cells, cells);
  for (int row = 0; row < cells; ++row) {
    const float* area = area_px.data() + (row + 1) * stride + 1;
    for (float& cell : strokes.row(row)) {
      cell = std::min(1.0F, per_line * *area++);
    }
  }
  return strokes;
}

float SketchCropper::distance_px(const Eigen::Vector2f& point_in_sketch) const {
  const Eigen::Vector2f wanted = point_in_sketch.array() - 0.5F;
  const Eigen::Vector2f last(static_cast<float>(distance_px_.width() - 1),
                             static_cast<float>(distance_px_.height() - 1));
  const Eigen::Vector2f inside = wanted.cwiseMax(0.0F).cwiseMin(last);
  const int column = std::min(static_cast<int>(inside.x()), distance_px_.width() - 2);
  const int row = std::min(static_cast<int>(inside.y()), distance_px_.height() - 2);
  const float beside_px = (wanted - inside).norm();
  if (column < 0 || row < 0) {  // one pixel wide or high
    return beside_px + distance_px_.at(cell_at((inside.array() + 0.5F).matrix().cast<double>()));
  }
  const float u = inside.x() - static_cast<float>(column);
  const float v = inside.y() - static_cast<float>(row);
  const float* low = distance_px_.row(row).data() + column;
  const float* high = distance_px_.row(row + 1).data() + column;
  return beside_px + (1.0F - v) * ((1.0F - u) * low[0] + u * low[1]) +
         v * ((1.0F - u) * high[0] + u * high[1]);
}

Grid<float> SketchCropper::nearness(const Sim2& cells_from_sketch, int cells) const {
  Grid<float> nearness(cells, cells);
  if (ink_columns_.empty()) {
    return nearness;
  }
  const Sim2 sketch_from_cells = cells_from_sketch.inverse();
  const Eigen::Vector2f along = sketch_from_cells.scaled_rotation_matrix().col(0).cast<float>();
  const auto slope =
      static_cast<float>(cells_from_sketch.scale() / SketchCrop::kNearnessReach_cells);
  for (int row = 0; row < cells; ++row) {
    Eigen::Vector2f point = (sketch_from_cells * centre_of({0, row})).cast<float>();
    for (float& cell : nearness.row(row)) {
      cell = std::max(0.0F, 1.0F - slope * distance_px(point));
      point += along;
    }
  }
  return nearness;
}

Grid<float> SketchCropper::visible_free(const Sim2& sketch_from_robot,
                                        const LocalWindow& window) const {
  constexpr double kStep_rad = 2.0 * std::numbers::pi / kBeams;
  const double reach_m = 1.5 * window.side_m;
  Scan expected{.first_angle_rad = -std::numbers::pi,
                .angle_step_rad = kStep_rad,
                .max_range_m = reach_m,
                .robot_from_laser = {},
                .ranges_m = std::vector<float>(kBeams)};
  std::array<float, kBeams> headings_rad{};
  for (std::size_t beam = 0; beam < kBeams; ++beam) {
    headings_rad[beam] = static_cast<float>(sketch_from_robot.yaw_rad() + expected.angle_rad(beam));
  }
  const auto px_per_m = static_cast<float>(sketch_from_robot.scale());
  caster_.cast(sketch_from_robot.translation(), headings_rad,
               static_cast<float>(reach_m) * px_per_m, expected.ranges_m);
  for (float& range : expected.ranges_m) {
    range /= px_per_m;
  }
  return raster_free_space(expected, window);
}

SketchCrop SketchCropper::crop(const Sim2& sketch_from_robot, const LocalWindow& window) const {
  const Sim2 cells_from_sketch = window.cells_from_robot() * sketch_from_robot.inverse();
  return {.strokes = strokes(cells_from_sketch, window.cells),
          .nearness = nearness(cells_from_sketch, window.cells),
          .visible_free = visible_free(sketch_from_robot, window)};
}

Grid<float> SketchCropper::upright_crop(const Eigen::Vector2d& centre_in_sketch, double side_px,
                                        int cells) const {
  const double cells_per_px = cells / side_px;
  const Eigen::Vector2d shift =
      Eigen::Vector2d::Constant(0.5 * cells) - cells_per_px * centre_in_sketch;
  Grid<float> crop(cells, cells);
  for_each_ink(Sim2::from_xy_yaw_scale(shift.x(), shift.y(), 0.0, cells_per_px), cells,
               [&](const Eigen::Vector2f& point, float) {
                 const Cell cell = cell_at(point.cast<double>());
                 if (crop.contains(cell)) {
                   crop.at(cell) = 1.0F;
                 }
               });
  return crop;
}

std::vector<Eigen::Vector2d> SketchCropper::ink_near(const Eigen::Vector2d& point_in_sketch,
                                                     double radius_px) const {
  check(radius_px >= 0.0, "a radius is a length");
  std::vector<Eigen::Vector2d> ink;
  const int rows = distance_px_.height();
  const auto row_at = [rows](double y) {
    return static_cast<int>(std::clamp(std::floor(y), 0.0, static_cast<double>(rows)));
  };
  const int end_row = row_at(point_in_sketch.y() + radius_px + 1.0);
  for (int row = row_at(point_in_sketch.y() - radius_px); row < end_row; ++row) {
    const auto here = static_cast<std::size_t>(row);
    for (std::size_t i = row_starts_[here]; i < row_starts_[here + 1]; ++i) {
      const Eigen::Vector2d centre = centre_of({ink_columns_[i], row});
      if ((centre - point_in_sketch).squaredNorm() <= radius_px * radius_px) {
        ink.push_back(centre);
      }
    }
  }
  return ink;
}

}  // namespace sketchloc

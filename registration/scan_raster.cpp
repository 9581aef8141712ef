#include "registration/scan_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kDirections = 1024;  ///< a third of a degree each: finer than beams are

/// A number in [0, 4) that grows with the angle of (x, y), counted from +x; no trigonometry.
float pseudo_angle(float x, float y) {
  const float p = x / (std::abs(x) + std::abs(y) + 1e-9F);
  return y >= 0.0F ? 1.0F - p : 3.0F + p;
}

std::size_t direction_of(float x, float y) {
  constexpr float kPerUnit = kDirections / 4.0F;
  return std::min(static_cast<std::size_t>(pseudo_angle(x, y) * kPerUnit), kDirections - 1);
}

/// The angle in the middle of every direction.
const std::array<double, kDirections>& direction_angles_rad() {
  static const std::array<double, kDirections> angles = [] {
    std::array<double, kDirections> values{};
    for (std::size_t i = 0; i < kDirections; ++i) {
      const double q = 4.0 * (static_cast<double>(i) + 0.5) / kDirections;
      const double x = q < 2.0 ? 1.0 - q : q - 3.0;
      const double y = (q < 2.0 ? 1.0 : -1.0) * (1.0 - std::abs(x));
      values[i] = std::atan2(y, x);
    }
    return values;
  }();
  return angles;
}

/// How far the scan saw in every direction of the laser frame, by its nearest beam; 0 where no beam
/// went or none came back.
std::array<float, kDirections> reach_by_direction(const Scan& scan) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const double step_rad = std::abs(scan.angle_step_rad);
  const double sense = scan.angle_step_rad < 0.0 ? -1.0 : 1.0;
  std::array<float, kDirections> reach_m{};
  if (!(step_rad > 0.0)) {
    return reach_m;
  }
  const std::array<double, kDirections>& angles = direction_angles_rad();
  for (std::size_t i = 0; i < kDirections; ++i) {
    // the angle past half a step before the first beam, in [0, 2 pi)
    const double past = sense * (angles[i] - scan.first_angle_rad) + 0.5 * step_rad;
    const double past_rad = past - kTurn_rad * std::floor(past / kTurn_rad);
    const auto beam = static_cast<std::size_t>(past_rad / step_rad);
    if (beam < scan.ranges_m.size() && scan.is_return(beam)) {
      reach_m[i] = scan.ranges_m[beam];
    }
  }
  return reach_m;
}

void raise_free_space(Grid<float>& seen_free, const Scan& scan, const Sim2& laser_from_cells) {
  const std::array<float, kDirections> reach_m = reach_by_direction(scan);
  const Eigen::Matrix2f linear = laser_from_cells.scaled_rotation_matrix().cast<float>();
  const auto per_m = static_cast<float>(1.0 / laser_from_cells.scale());
  for (int row = 0; row < seen_free.height(); ++row) {
    const Eigen::Vector2f start = (laser_from_cells * centre_of({0, row})).cast<float>();
    float column = 0.0F;
    for (float& cell : seen_free.row(row)) {
      const float x = start.x() + column * linear(0, 0);
      const float y = start.y() + column * linear(1, 0);
      const float left_m = reach_m[direction_of(x, y)] - std::sqrt(x * x + y * y);
      cell = std::max(cell, std::clamp(left_m * per_m + 0.5F, 0.0F, 1.0F));
      column += 1.0F;
    }
  }
}

/// Adds weight 1 to the four cells whose centres are nearest, in bilinear shares.
void splat(Grid<float>& cells, const Eigen::Vector2d& point) {
  const Eigen::Vector2d from_centre = point - Eigen::Vector2d(0.5, 0.5);
  const Cell low = cell_at(from_centre);
  if (low.column < -1 || low.row < -1 || low.column >= cells.width() || low.row >= cells.height()) {
    return;
  }
  const auto u = static_cast<float>(from_centre.x() - low.column);
  const auto v = static_cast<float>(from_centre.y() - low.row);
  const std::array<float, 4> shares = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Cell cell = {low.column + static_cast<int>(i % 2), low.row + static_cast<int>(i / 2)};
    if (cells.contains(cell)) {
      cells.at(cell) += shares[i];
    }
  }
}

void limit_to_one(Grid<float>& cells) {
  for (int row = 0; row < cells.height(); ++row) {
    for (float& cell : cells.row(row)) {
      cell = std::min(cell, 1.0F);
    }
  }
}

/// Calls visit(end point in laser coordinates) for every beam that returned.
template <typename Visit>
void for_each_end_point(const Scan& scan, Visit&& visit) {
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (scan.is_return(beam)) {
      const double angle_rad = scan.angle_rad(beam);
      const double range_m = scan.ranges_m[beam];
      visit(Eigen::Vector2d(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)));
    }
  }
}

}  // namespace

void validate(const LocalWindow& window) {
  require_above("side_m", window.side_m, 0.0);
  require_at_least("cells", window.cells, 1.0);
  require_in_range("ahead_m", window.ahead_m, -window.side_m, window.side_m);
}

ScanRaster raster_scans(std::span<const PlacedScan> scans, const LocalWindow& window) {
  ScanRaster raster{.end_points = Grid<float>(window.cells, window.cells),
                    .seen_free = Grid<float>(window.cells, window.cells)};
  for (const PlacedScan& placed : scans) {
    check(placed.scan != nullptr, "a placed scan has a scan");
    const Se2 robot_from_laser = placed.robot_from_then * placed.scan->robot_from_laser;
    const Sim2 cells_from_laser = window.cells_from_robot() * robot_from_laser;
    for_each_end_point(*placed.scan, [&](const Eigen::Vector2d& point) {
      splat(raster.end_points, cells_from_laser * point);
    });
    raise_free_space(raster.seen_free, *placed.scan, cells_from_laser.inverse());
  }
  limit_to_one(raster.end_points);
  return raster;
}

Grid<float> binary_scan_raster(const Scan& scan, const LocalWindow& window) {
  Grid<float> cells(window.cells, window.cells);
  const Sim2 cells_from_laser = window.cells_from_robot() * scan.robot_from_laser;
  for_each_end_point(scan, [&](const Eigen::Vector2d& point) {
    const Cell cell = cell_at(cells_from_laser * point);
    if (cells.contains(cell)) {
      cells.at(cell) = 1.0F;
    }
  });
  return cells;
}

Grid<float> raster_free_space(const Scan& scan, const LocalWindow& window) {
  Grid<float> seen_free(window.cells, window.cells);
  const Sim2 cells_from_laser = window.cells_from_robot() * scan.robot_from_laser;
  raise_free_space(seen_free, scan, cells_from_laser.inverse());
  return seen_free;
}

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "datasets/grid.hpp"

namespace sketchloc {

/// Distances along rays to the first occupied cell of a grid, exact and fast.
///
/// All lengths are in cells and all points in cell units, as in Grid: cell (column, row) covers
/// [column, column + 1) x [row, row + 1), y up, headings counter-clockwise from +x. The range is
/// the distance to the point where the ray enters the first occupied cell, as a cell-by-cell
/// traversal finds it [Amanatides87], up to rounding in float. Outside the grid nothing is
/// occupied. Immutable after construction; safe to share between threads.
class RayCaster {
 public:
  /// Anything but zero is occupied. Work and memory (4 bytes per cell) are linear in the cells.
  explicit RayCaster(const Grid<std::uint8_t>& occupied);

  /// Range in [0, max_range]: 0 from an occupied cell, `max_range` where nothing is hit before.
  float range(const Eigen::Vector2d& origin, float heading_rad, float max_range) const;

  /// The same for many headings from one origin, into `ranges` of the same length. Several
  /// times faster per ray than `range`; the same bits on every processor.
  void cast(const Eigen::Vector2d& origin, std::span<const float> heading_rad, float max_range,
            std::span<float> ranges) const;

  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_ = 0;
  int height_ = 0;
  /// Four planes, one per quadrant of directions: for every cell the side of the largest square of
  /// free cells that has this cell at its corner and reaches into the quadrant; 0 = occupied.
  std::vector<std::uint8_t> free_squares_;
};

}  // namespace sketchloc

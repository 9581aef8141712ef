#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "motion/check.hpp"

namespace sketchloc {

/// Column and row of a grid cell; row 0 is at the bottom (y up).
struct Cell {
  int column = 0;
  int row = 0;
  bool operator==(const Cell&) const = default;
};

/// Dense 2D array over a plane with y up. Cell (column, row) covers [column, column + 1) x
/// [row, row + 1) in cell units, so its centre is at (column + 0.5, row + 0.5).
template <typename T>
class Grid {
 public:
  Grid() = default;
  Grid(int width, int height, const T& fill = T{}) : width_(width), height_(height) {
    check(width >= 0 && height >= 0, "a grid has no negative size");
    cells_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return cells_.empty(); }

  bool contains(const Cell& cell) const {
    return cell.column >= 0 && cell.column < width_ && cell.row >= 0 && cell.row < height_;
  }
  const T& at(const Cell& cell) const {
    check(contains(cell), "cell outside the grid");
    return cells_[offset(cell)];
  }
  T& at(const Cell& cell) {
    check(contains(cell), "cell outside the grid");
    return cells_[offset(cell)];
  }

  /// One row, bottom row first; the way for inner loops.
  std::span<const T> row(int row) const {
    check(row >= 0 && row < height_, "row outside the grid");
    return {cells_.data() + offset({0, row}), static_cast<std::size_t>(width_)};
  }
  std::span<T> row(int row) {
    check(row >= 0 && row < height_, "row outside the grid");
    return {cells_.data() + offset({0, row}), static_cast<std::size_t>(width_)};
  }

  /// All cells, row by row from the bottom.
  std::span<const T> cells() const { return cells_; }

  bool operator==(const Grid&) const = default;

 private:
  std::size_t offset(const Cell& cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(cell.column);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> cells_;
};

/// The cell that holds a point in cell units; check contains() before use. Points too far for an
/// int, and NaN, give a cell outside every grid.
inline Cell cell_at(const Eigen::Vector2d& point) {
  const auto index = [](double coordinate) {
    constexpr double kFar = 1 << 30;
    return std::abs(coordinate) < kFar ? static_cast<int>(std::floor(coordinate)) : -1;
  };
  return {index(point.x()), index(point.y())};
}

inline Eigen::Vector2d centre_of(const Cell& cell) { return {cell.column + 0.5, cell.row + 0.5}; }

/// Bilinear value between cell centres at a point in cell units; none outside the outermost
/// centres.
std::optional<float> sample(const Grid<float>& grid, const Eigen::Vector2d& point);

}  // namespace sketchloc

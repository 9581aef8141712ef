#include "datasets/grid.hpp"

#include <algorithm>

namespace sketchloc {

std::optional<float> sample(const Grid<float>& grid, const Eigen::Vector2d& point) {
  const double x = point.x() - 0.5;
  const double y = point.y() - 0.5;
  if (!(x >= 0.0 && y >= 0.0 && x <= grid.width() - 1.0 && y <= grid.height() - 1.0)) {
    return std::nullopt;
  }
  const int column = std::min(static_cast<int>(x), std::max(grid.width() - 2, 0));
  const int row = std::min(static_cast<int>(y), std::max(grid.height() - 2, 0));
  const int right = std::min(column + 1, grid.width() - 1);
  const int above = std::min(row + 1, grid.height() - 1);
  const float u = static_cast<float>(x - column);
  const float v = static_cast<float>(y - row);
  const float bottom = (1 - u) * grid.at({column, row}) + u * grid.at({right, row});
  const float top = (1 - u) * grid.at({column, above}) + u * grid.at({right, above});
  return (1 - v) * bottom + v * top;
}

}  // namespace sketchloc

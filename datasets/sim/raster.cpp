#include "datasets/sim/raster.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/sim/detail/polyline.hpp"

namespace sketchloc {
namespace {

struct CellBox {
  int first_column = 0;
  int last_column = -1;
  int first_row = 0;
  int last_row = -1;
};

/// The cells of the grid that a box around two points can touch.
CellBox cells_around(const Grid<std::uint8_t>& cells, const Eigen::Vector2d& low,
                     const Eigen::Vector2d& high) {
  const auto clamped = [](double value, int last) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, static_cast<double>(last)));
  };
  const bool outside =
      high.x() < 0.0 || high.y() < 0.0 || low.x() >= cells.width() || low.y() >= cells.height();
  if (outside || cells.empty()) {
    return {};
  }
  return {clamped(low.x(), cells.width() - 1), clamped(high.x(), cells.width() - 1),
          clamped(low.y(), cells.height() - 1), clamped(high.y(), cells.height() - 1)};
}

template <typename Covers>
void paint_where(Grid<std::uint8_t>& cells, const CellBox& box, std::uint8_t value,
                 const Covers& covers) {
  for (int row = box.first_row; row <= box.last_row; ++row) {
    for (int column = box.first_column; column <= box.last_column; ++column) {
      if (covers(centre_of({column, row}))) {
        cells.at({column, row}) = value;
      }
    }
  }
}

}  // namespace

void paint_line(Grid<std::uint8_t>& cells, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                double width, std::uint8_t value) {
  const double radius = 0.5 * width;
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius + 1.0);
  paint_where(cells, cells_around(cells, from.cwiseMin(to) - reach, from.cwiseMax(to) + reach),
              value, [&](const Eigen::Vector2d& centre) {
                return detail::distance_to_segment(centre, from, to) <= radius;
              });
  const int steps = 1 + static_cast<int>(2.0 * (to - from).norm());
  for (int step = 0; step <= steps; ++step) {
    const Eigen::Vector2d point = from + (to - from) * (static_cast<double>(step) / steps);
    if (cells.contains(cell_at(point))) {
      cells.at(cell_at(point)) = value;
    }
  }
}

void paint_polyline(Grid<std::uint8_t>& cells, std::span<const Eigen::Vector2d> points,
                    double width, std::uint8_t value) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    paint_line(cells, points[i], points[i + 1], width, value);
  }
}

void paint_convex(Grid<std::uint8_t>& cells, std::span<const Eigen::Vector2d> corners,
                  std::uint8_t value) {
  if (corners.empty()) {
    return;
  }
  Eigen::Vector2d low = corners[0];
  Eigen::Vector2d high = corners[0];
  for (const Eigen::Vector2d& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  paint_where(cells, cells_around(cells, low, high), value, [&](const Eigen::Vector2d& centre) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
      const Eigen::Vector2d offset = centre - corners[i];
      if (side.x() * offset.y() - side.y() * offset.x() < 0.0) {
        return false;
      }
    }
    return true;
  });
}

}  // namespace sketchloc

#include "datasets/sim/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

double squared_distance_to_line(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                                const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double squared_length = along.squaredNorm();
  const double share =
      squared_length > 0.0 ? std::clamp((point - from).dot(along) / squared_length, 0.0, 1.0) : 0.0;
  return (point - from - share * along).squaredNorm();
}

/// One chamfer pass; `direction` is 1 from the bottom left, -1 from the top right.
void sweep(Grid<float>& distance, int direction) {
  struct Neighbour {
    Cell offset;
    float length;
  };
  constexpr std::array<Neighbour, 8> kBehind = {{{{-1, 0}, 1.0F},
                                                 {{0, -1}, 1.0F},
                                                 {{-1, -1}, 1.4F},
                                                 {{1, -1}, 1.4F},
                                                 {{-2, -1}, 2.2F},
                                                 {{-1, -2}, 2.2F},
                                                 {{1, -2}, 2.2F},
                                                 {{2, -1}, 2.2F}}};
  const int cells = distance.width() * distance.height();
  for (int i = 0; i < cells; ++i) {
    const int index = direction > 0 ? i : cells - 1 - i;
    const Cell cell = {index % distance.width(), index / distance.width()};
    float& here = distance.at(cell);
    for (const Neighbour& neighbour : kBehind) {
      const Cell behind = {cell.column + direction * neighbour.offset.column,
                           cell.row + direction * neighbour.offset.row};
      if (distance.contains(behind)) {
        here = std::min(here, distance.at(behind) + neighbour.length);
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
                return squared_distance_to_line(centre, from, to) <= radius * radius;
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

Grid<float> clearance(const Grid<std::uint8_t>& cells) {
  const auto unreachable = static_cast<float>(2 * (cells.width() + cells.height()) + 1);
  Grid<float> distance(cells.width(), cells.height(), unreachable);
  for (int row = 0; row < cells.height(); ++row) {
    for (int column = 0; column < cells.width(); ++column) {
      if (cells.at({column, row}) != 0) {
        distance.at({column, row}) = 0.0F;
      }
    }
  }
  sweep(distance, 1);
  sweep(distance, -1);
  return distance;
}

}  // namespace sketchloc

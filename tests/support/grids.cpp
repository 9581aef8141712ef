#include "tests/support/grids.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace sketchloc::testing {
namespace {

bool is_wall(int along, int across, int room, int door) {
  if (across % room != 0) {
    return false;
  }
  return std::abs(along % room - room / 2) * 2 > door || across == 0;
}

}  // namespace

Grid<std::uint8_t> rooms(int width, int height, int room, int door) {
  Grid<std::uint8_t> occupied(width, height);
  const int table = room / 6;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const bool border = row == height - 1 || column == width - 1;
      const bool wall = is_wall(column, row, room, door) || is_wall(row, column, room, door);
      const int x = column % room;
      const int y = row % room;
      const bool table_low = x > table && x < 2 * table && y > table && y < 2 * table;
      const bool table_high = x > 4 * table && x < 5 * table && y > 4 * table && y < 4 * table + 3;
      occupied.at({column, row}) = border || wall || table_low || table_high ? 1 : 0;
    }
  }
  return occupied;
}

Grid<std::uint8_t> thin_strokes(int width, int height, int strokes, std::uint64_t seed) {
  Grid<std::uint8_t> occupied(width, height);
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> along_x(0.0, width);
  std::uniform_real_distribution<double> along_y(0.0, height);
  std::uniform_real_distribution<double> length(5.0, 0.4 * std::max(width, height));
  std::uniform_real_distribution<double> turn(-3.2, 3.2);
  for (int stroke = 0; stroke < strokes; ++stroke) {
    const Eigen::Vector2d start(along_x(engine), along_y(engine));
    const double heading = turn(engine);
    const Eigen::Vector2d way(std::cos(heading), std::sin(heading));
    const Eigen::Vector2d step = way / way.cwiseAbs().maxCoeff();
    const int cells = static_cast<int>(length(engine));
    for (int i = 0; i < cells; ++i) {
      const Cell cell = cell_at(start + i * step);
      if (occupied.contains(cell)) {
        occupied.at(cell) = 1;
      }
    }
  }
  return occupied;
}

}  // namespace sketchloc::testing

#include <algorithm>
#include <cmath>

#include "datasets/sim/building.hpp"
#include "datasets/sim/detail/plan_builder.hpp"
#include "datasets/sim/detail/wall_tracing.hpp"
#include "datasets/sim/raster.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

Grid<std::uint8_t> inverted(const Grid<std::uint8_t>& cells) {
  Grid<std::uint8_t> result = cells;
  for (int row = 0; row < result.height(); ++row) {
    for (std::uint8_t& cell : result.row(row)) {
      cell = cell == 0 ? 1 : 0;
    }
  }
  return result;
}

/// The walls as far as they can be seen: occupied cells near free ones.
Grid<std::uint8_t> wall_band(const Grid<std::uint8_t>& occupied, double depth_cells) {
  const Grid<float> to_free = clearance(inverted(occupied));
  Grid<std::uint8_t> band = occupied;
  for (int row = 0; row < band.height(); ++row) {
    for (int column = 0; column < band.width(); ++column) {
      std::uint8_t& cell = band.at({column, row});
      cell = cell != 0 && static_cast<double>(to_free.at({column, row})) <= depth_cells ? 1 : 0;
    }
  }
  return band;
}

double length(const std::vector<Eigen::Vector2d>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    sum += (line[i] - line[i - 1]).norm();
  }
  return sum;
}

std::vector<Wall> trace_walls(const MetricMap& map, const MapReadingParams& params) {
  const Grid<std::uint8_t> lines =
      detail::thin(wall_band(map.cells, params.solid_depth_m / map.cell_m));
  std::vector<Wall> walls;
  for (const std::vector<Eigen::Vector2d>& traced : detail::trace_lines(lines)) {
    if (length(traced) * map.cell_m < params.min_wall_m) {
      continue;
    }
    const std::vector<Eigen::Vector2d> line =
        detail::simplify(traced, params.tolerance_m / map.cell_m);
    for (std::size_t i = 1; i < line.size(); ++i) {
      walls.push_back({.from_in_world = map.world_from_cells(line[i - 1]),
                       .to_in_world = map.world_from_cells(line[i])});
    }
  }
  return walls;
}

/// Rectangles of random size that tile the map; only those with free floor stand for rooms.
std::vector<Room> pieces_of_floor(const MetricMap& map, double room_size_m, Rng& rng) {
  const Eigen::Vector2d size_m =
      map.cell_m * Eigen::Vector2d(map.cells.width(), map.cells.height());
  const PlaneBox all = {map.origin_in_world, map.origin_in_world + size_m};
  std::vector<Room> rooms =
      detail::subdivide(all, 0.6 * room_size_m, room_size_m * room_size_m, rng);
  std::erase_if(rooms, [&](const Room& room) {
    const Cell low = cell_at(map.cells_from_world(room.box_in_world.low));
    const Cell high = cell_at(map.cells_from_world(room.box_in_world.high));
    for (int row = low.row; row < std::min(high.row, map.cells.height()); ++row) {
      for (int column = low.column; column < std::min(high.column, map.cells.width()); ++column) {
        if (map.cells.at({column, row}) == MetricMap::Free) {
          return false;
        }
      }
    }
    return true;
  });
  return rooms;
}

}  // namespace

Building building_from_map(const Grid<std::uint8_t>& occupied, double cell_m, Rng& rng,
                           const MapReadingParams& params) {
  check(cell_m > 0.0 && !occupied.empty(), "a map has cells with a size");
  Building building{.plan = {}, .map = {.cells = occupied, .cell_m = cell_m}};
  for (int row = 0; row < occupied.height(); ++row) {
    for (std::uint8_t& cell : building.map.cells.row(row)) {
      cell = cell != 0 ? MetricMap::Solid : MetricMap::Free;
    }
  }
  building.plan.walls = trace_walls(building.map, params);
  building.plan.rooms = pieces_of_floor(building.map, params.room_size_m, rng);
  return building;
}

}  // namespace sketchloc

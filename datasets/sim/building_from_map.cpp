#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "datasets/sim/building.hpp"
#include "datasets/sim/detail/plan_builder.hpp"
#include "datasets/sim/detail/wall_tracing.hpp"
#include "motion/check.hpp"
#include "motion/number_text.hpp"
#include "motion/validate.hpp"
#include "registration/distance_field.hpp"

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

constexpr std::array<Cell, 4> kBeside = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// The connected free cells around a free cell; clears them in `free`.
std::vector<Cell> take_component(Grid<std::uint8_t>& free, const Cell& start) {
  std::vector<Cell> component{start};
  free.at(start) = 0;
  for (std::size_t next = 0; next < component.size(); ++next) {
    for (const Cell& offset : kBeside) {
      const Cell cell = {component[next].column + offset.column, component[next].row + offset.row};
      if (free.contains(cell) && free.at(cell) != 0) {
        free.at(cell) = 0;
        component.push_back(cell);
      }
    }
  }
  return component;
}

/// Solid cells everywhere but in free spaces of some size: specks and frames are no rooms.
Grid<std::uint8_t> solid_without_specks(const Grid<std::uint8_t>& occupied, double min_cells) {
  Grid<std::uint8_t> solid(occupied.width(), occupied.height(), MetricMap::Solid);
  Grid<std::uint8_t> free = inverted(occupied);
  for (int row = 0; row < free.height(); ++row) {
    for (int column = 0; column < free.width(); ++column) {
      if (free.at({column, row}) == 0) {
        continue;
      }
      const std::vector<Cell> component = take_component(free, {column, row});
      if (static_cast<double>(component.size()) >= min_cells) {
        for (const Cell& cell : component) {
          solid.at(cell) = MetricMap::Free;
        }
      }
    }
  }
  return solid;
}

/// The walls as far as they can be seen: occupied cells near free ones.
Grid<std::uint8_t> wall_band(const Grid<std::uint8_t>& occupied, double depth_cells) {
  const Grid<float> to_free = distance_field_px(inverted(occupied));
  Grid<std::uint8_t> band = occupied;
  for (int row = 0; row < band.height(); ++row) {
    for (int column = 0; column < band.width(); ++column) {
      std::uint8_t& cell = band.at({column, row});
      cell = cell != 0 && static_cast<double>(to_free.at({column, row})) <= depth_cells ? 1 : 0;
    }
  }
  return band;
}

std::vector<Wall> trace_walls(const MetricMap& map, const MapReadingParams& params) {
  const Grid<std::uint8_t> lines =
      detail::thin(wall_band(map.cells, params.solid_depth_m / map.cell_m));
  std::vector<Wall> walls;
  for (const detail::Polyline& traced : detail::trace_lines(lines)) {
    if (detail::length(traced) * map.cell_m < params.min_wall_m) {
      continue;
    }
    const detail::Polyline line = detail::simplify(traced, params.tolerance_m / map.cell_m);
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

/// Large maps take hours, and hardly any building is that large.
void require_size(const Grid<std::uint8_t>& cells, double cell_m, double max_side_m) {
  const double width_m = cells.width() * cell_m;
  const double height_m = cells.height() * cell_m;
  if (std::max(width_m, height_m) > max_side_m) {
    throw std::invalid_argument("the map is " + number_text(std::round(width_m)) + " m x " +
                                number_text(std::round(height_m)) + " m with cells of " +
                                number_text(cell_m) + " m, more than max_side_m, " +
                                number_text(max_side_m) + " m");
  }
}

}  // namespace

void validate(const MapReadingParams& reading) {
  require_at_least("min_wall_m", reading.min_wall_m, 0.0);
  require_above("tolerance_m", reading.tolerance_m, 0.0);
  require_at_least("min_floor_m2", reading.min_floor_m2, 0.0);
  require_at_least("room_size_m", reading.room_size_m, 0.5);
  require_above("solid_depth_m", reading.solid_depth_m, 0.0);
  require_above("max_side_m", reading.max_side_m, 0.0);
}

Building building_from_map(const Grid<std::uint8_t>& occupied, double cell_m, Rng& rng,
                           const MapReadingParams& params) {
  validate(params);
  check(cell_m > 0.0 && !occupied.empty(), "a map has cells with a size");
  require_size(occupied, cell_m, params.max_side_m);
  const double min_cells = params.min_floor_m2 / (cell_m * cell_m);
  Building building{.plan = {},
                    .map = {.cells = solid_without_specks(occupied, min_cells), .cell_m = cell_m}};
  building.plan.walls = trace_walls(building.map, params);
  building.plan.rooms = pieces_of_floor(building.map, params.room_size_m, rng);
  return building;
}

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "datasets/grid.hpp"
#include "datasets/sim/floor_plan.hpp"
#include "motion/random.hpp"

namespace sketchloc {

/// What the LIDAR meets, as metric cells.
struct MetricMap {
  enum Material : std::uint8_t { Free = 0, Solid = 1, Glass = 2 };
  Grid<std::uint8_t> cells;  ///< of Material
  double cell_m = 0.05;
  Eigen::Vector2d origin_in_world = Eigen::Vector2d::Zero();  ///< lower left corner of cell (0, 0)

  Eigen::Vector2d cells_from_world(const Eigen::Vector2d& point) const {
    return (point - origin_in_world) / cell_m;
  }
  Eigen::Vector2d world_from_cells(const Eigen::Vector2d& point) const {
    return origin_in_world + cell_m * point;
  }
};

/// A building twice: the lines that a person may draw, and everything that the LIDAR sees.
struct Building {
  FloorPlan plan;
  MetricMap map;
};

/// Cells for walls, furniture and glass, with a free margin around.
MetricMap rasterise(const FloorPlan& plan, double cell_m = 0.05);

Building building_from_plan(FloorPlan plan);

struct MapReadingParams {
  double min_wall_m = 0.4;     ///< shorter pieces of wall are details, not lines, >= 0
  double tolerance_m = 0.08;   ///< how far a line may run from the wall's middle, > 0
  double min_floor_m2 = 4.0;   ///< smaller free spaces are taken for solid, >= 0
  double room_size_m = 4.0;    ///< side of the pieces of floor that stand for rooms, > 0
  double solid_depth_m = 0.3;  ///< a wall thicker than twice this is drawn as its faces, > 0
  double max_side_m = 400.0;   ///< a larger map is an error: its scale is most likely wrong, > 0
};

template <typename Visitor>
void visit_fields(MapReadingParams& reading, Visitor&& visit) {
  visit("min_wall_m", reading.min_wall_m);
  visit("tolerance_m", reading.tolerance_m);
  visit("min_floor_m2", reading.min_floor_m2);
  visit("room_size_m", reading.room_size_m);
  visit("solid_depth_m", reading.solid_depth_m);
  visit("max_side_m", reading.max_side_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const MapReadingParams& reading);

/// A real building's occupancy map (1 = occupied or unknown) as a building: its walls are traced
/// into lines, and pieces of its free space stand for rooms. Throws std::invalid_argument for a map
/// with a longer side than params.max_side_m.
Building building_from_map(const Grid<std::uint8_t>& occupied, double cell_m, Rng& rng,
                           const MapReadingParams& params = {});

}  // namespace sketchloc

#include "datasets/sim/building.hpp"

#include <cmath>

#include "datasets/sim/raster.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kMargin_m = 1.0;

void paint_wall(MetricMap& map, const Wall& wall) {
  paint_line(map.cells, map.cells_from_world(wall.from_in_world),
             map.cells_from_world(wall.to_in_world), wall.thickness_m / map.cell_m,
             wall.glass ? MetricMap::Glass : MetricMap::Solid);
}

void paint_furniture(MetricMap& map, const Furniture& item) {
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& corner : item.corners_in_world()) {
    corners.push_back(map.cells_from_world(corner));
  }
  paint_convex(map.cells, corners, MetricMap::Solid);
}

}  // namespace

MetricMap rasterise(const FloorPlan& plan, double cell_m) {
  check(cell_m > 0.0, "cells have a size");
  const PlaneBox box = bounds_in_world(plan).grown(kMargin_m);
  const Eigen::Vector2d size = box.size() / cell_m;
  MetricMap map{.cells = Grid<std::uint8_t>(static_cast<int>(std::ceil(size.x())),
                                            static_cast<int>(std::ceil(size.y()))),
                .cell_m = cell_m,
                .origin_in_world = box.low};
  for (const Furniture& item : plan.furniture) {
    paint_furniture(map, item);
  }
  for (const bool glass : {true, false}) {  // solid last: it covers the ends of glass walls
    for (const Wall& wall : plan.walls) {
      if (wall.glass == glass) {
        paint_wall(map, wall);
      }
    }
  }
  return map;
}

Building building_from_plan(FloorPlan plan) {
  MetricMap map = rasterise(plan);
  return {std::move(plan), std::move(map)};
}

}  // namespace sketchloc

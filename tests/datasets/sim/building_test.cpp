#include "datasets/sim/building.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "datasets/sim/detail/polyline.hpp"
#include "datasets/sim/plan_generators.hpp"

namespace sketchloc {
namespace {

TEST(Rasterise, PutsWallsFurnitureAndGlassWhereThePlanHasThem) {
  FloorPlan plan;
  plan.walls = {{.from_in_world = {0.0, 0.0}, .to_in_world = {5.0, 0.0}},
                {.from_in_world = {0.0, 4.0}, .to_in_world = {5.0, 4.0}, .glass = true}};
  plan.furniture = {{.centre_in_world = {2.0, 2.0}, .half_size_m = {0.5, 0.3}}};
  const MetricMap map = rasterise(plan);
  const auto material = [&](double x, double y) {
    return map.cells.at(cell_at(map.cells_from_world({x, y})));
  };
  EXPECT_EQ(material(2.5, 0.0), MetricMap::Solid);
  EXPECT_EQ(material(2.5, 4.0), MetricMap::Glass);
  EXPECT_EQ(material(2.3, 2.1), MetricMap::Solid);
  EXPECT_EQ(material(3.5, 2.0), MetricMap::Free);
  EXPECT_TRUE(
      map.world_from_cells(map.cells_from_world({1.0, 2.0})).isApprox(Eigen::Vector2d(1, 2)));
}

double distance_to_walls_m(const std::vector<Wall>& walls, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) {
    nearest =
        std::min(nearest, detail::distance_to_segment(point, wall.from_in_world, wall.to_in_world));
  }
  return nearest;
}

/// A home without furniture as a map: everything that cannot be reached counts as occupied.
struct KnownMap {
  FloorPlan plan;
  MetricMap map;
};
KnownMap known_map() {
  Rng rng = make_rng(4);
  FloorPlan plan = make_home(rng);
  plan.furniture.clear();
  MetricMap map = rasterise(plan);
  return {std::move(plan), std::move(map)};
}

TEST(BuildingFromMap, TracesTheWallsOfTheMap) {
  const KnownMap known = known_map();
  Rng rng = make_rng(1);
  const Building building = building_from_map(known.map.cells, known.map.cell_m, rng);
  double on_wall_m = 0.0;
  double total_m = 0.0;
  for (const Wall& wall : known.plan.walls) {
    for (double way_m = 0.0; way_m < wall.length_m(); way_m += 0.1) {
      const Eigen::Vector2d in_world =
          wall.from_in_world + way_m * (wall.to_in_world - wall.from_in_world).normalized() -
          known.map.origin_in_world;
      on_wall_m += distance_to_walls_m(building.plan.walls, in_world) < 0.15 ? 0.1 : 0.0;
      total_m += 0.1;
    }
  }
  EXPECT_GT(on_wall_m, 0.93 * total_m);
}

TEST(BuildingFromMap, TracesNothingThatIsNoWall) {
  const KnownMap known = known_map();
  Rng rng = make_rng(1);
  const Building building = building_from_map(known.map.cells, known.map.cell_m, rng);
  for (const Wall& wall : building.plan.walls) {
    const Eigen::Vector2d middle =
        0.5 * (wall.from_in_world + wall.to_in_world) + known.map.origin_in_world;
    EXPECT_LT(distance_to_walls_m(known.plan.walls, middle), 0.25);
  }
}

TEST(BuildingFromMap, TakesSpecksOfFreeSpaceForSolid) {
  Grid<std::uint8_t> occupied(200, 200, 1);
  for (int row = 20; row < 180; ++row) {
    for (int column = 20; column < 120; ++column) {
      occupied.at({column, row}) = 0;
    }
    occupied.at({199, row}) = 0;  // an unclean border
  }
  Rng rng = make_rng(1);
  const Building building = building_from_map(occupied, 0.05, rng);
  EXPECT_EQ(building.map.cells.at({199, 50}), MetricMap::Solid);
  EXPECT_EQ(building.map.cells.at({50, 50}), MetricMap::Free);
  for (const Wall& wall : building.plan.walls) {
    EXPECT_LT(wall.from_in_world.x(), 120 * 0.05 + 0.4);
  }
}

TEST(MapReadingParams, RejectValuesOutOfRange) {
  EXPECT_NO_THROW(validate(MapReadingParams{}));
  EXPECT_THROW(validate(MapReadingParams{.tolerance_m = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

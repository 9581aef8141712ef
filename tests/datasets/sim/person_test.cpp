#include "datasets/sim/person.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "datasets/sim/drawing_statistics.hpp"
#include "datasets/sim/drive.hpp"
#include "datasets/sim/plan_generators.hpp"
#include "motion/angles.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

FloorPlan plan(BuildingKind kind, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  return make_plan(kind, rng);
}

Drawing drawn(const FloorPlan& floor_plan, const PersonParams& person, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  return draw(floor_plan, person, rng);
}

TEST(Person, SaysThatThereIsNothingToDraw) {
  EXPECT_EQ(drawn({}, human_person(), 1).status, Drawing::Status::NothingToDraw);
  FloorPlan corner;
  corner.walls.push_back({.from_in_world = {0.0, 0.0}, .to_in_world = {3.0, 0.0}});
  corner.walls.push_back({.from_in_world = {3.0, 0.0}, .to_in_world = {3.0, 2.0}});
  EXPECT_EQ(drawn(corner, tps_person(), 1).status, Drawing::Status::Drawn);
  PersonParams lazy = tps_person();
  lazy.pen.left_out_share = 1.0;
  EXPECT_EQ(drawn(corner, lazy, 1).status, Drawing::Status::NothingToDraw);
}

TEST(HumanPersonStatistical, NeverFoldsTheBuilding) {
  for (const BuildingKind kind :
       {BuildingKind::Home, BuildingKind::Office, BuildingKind::Warehouse}) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const FloorPlan floor_plan = plan(kind, seed);
      const Drawing drawing = drawn(floor_plan, human_person(), seed);
      const FoldReport folds = find_folds(
          [&](const Eigen::Vector2d& point) { return drawing.sketch_from_world.at(point); },
          bounds_in_world(floor_plan).grown(1.0), 80);
      EXPECT_FALSE(folds.folds()) << seed << ": " << folds.worst_point.transpose();
    }
  }
}

TEST(TpsPerson, DrawsEveryWallWhereTheDeformationPutsIt) {
  const FloorPlan floor_plan = plan(BuildingKind::Office, 3);
  const Drawing drawing = drawn(floor_plan, tps_person(), 3);
  for (const Wall& wall : floor_plan.walls) {
    for (const double share : {0.0, 0.37, 0.81, 1.0}) {
      const Eigen::Vector2d in_world =
          wall.from_in_world + share * (wall.to_in_world - wall.from_in_world);
      const Cell cell = cell_at(drawing.sketch_from_world(in_world));
      EXPECT_EQ(drawing.sketch.occupied.at(cell), 1);
    }
  }
}

TEST(HumanPerson, DrawsMostWallsNearWhereTheDeformationPutsThem) {
  const FloorPlan floor_plan = plan(BuildingKind::Office, 4);
  const Drawing drawing = drawn(floor_plan, human_person(), 4);
  const Grid<float> distance_px = distance_field_px(drawing.sketch.occupied);
  double near_m = 0.0;
  double total_m = 0.0;
  for (const Wall& wall : floor_plan.walls) {
    const Eigen::Vector2d in_sketch =
        drawing.sketch_from_world(0.5 * (wall.from_in_world + wall.to_in_world));
    near_m += distance_px.at(cell_at(in_sketch)) < 6.0F ? wall.length_m() : 0.0;
    total_m += wall.length_m();
  }
  EXPECT_GT(near_m, 0.85 * total_m);
}

TEST(HumanPerson, DrawsAnotherDrawingEachTime) {
  const FloorPlan floor_plan = plan(BuildingKind::Home, 4);
  EXPECT_NE(drawn(floor_plan, human_person(), 1).sketch.occupied,
            drawn(floor_plan, human_person(), 2).sketch.occupied);
}

TEST(HumanPerson, LeavesPaperAroundTheDrawing) {
  const Drawing drawing = drawn(plan(BuildingKind::Home, 4), human_person(), 1);
  const Grid<std::uint8_t>& occupied = drawing.sketch.occupied;
  for (int column = 0; column < occupied.width(); ++column) {
    EXPECT_EQ(occupied.at({column, 0}), 0);
    EXPECT_EQ(occupied.at({column, occupied.height() - 1}), 0);
  }
}

TEST(TrueMap, IsTheMapWithItsScale) {
  const Building building = building_from_plan(plan(BuildingKind::Home, 1));
  const Drawing drawing = true_map(building);
  EXPECT_DOUBLE_EQ(drawing.sketch.px_per_m.value(), 20.0);
  const Eigen::Vector2d on_wall = building.plan.walls[0].from_in_world;
  EXPECT_EQ(drawing.sketch.occupied.at(cell_at(drawing.sketch_from_world(on_wall))), 1);
  EXPECT_DOUBLE_EQ(drawing.sketch_from_world.sketch_from_robot({}).scale(), 20.0);
}

TEST(PersonParams, RejectValuesOutOfRangeByName) {
  EXPECT_NO_THROW(validate(human_person()));
  EXPECT_NO_THROW(validate(tps_person()));
  PersonParams person = human_person();
  person.pen.max_stroke_px = 0.5;
  EXPECT_THROW(validate(person), std::invalid_argument);
  person = human_person();
  person.distortion.straightness = 0.0;
  EXPECT_THROW(validate(person), std::invalid_argument);
}

/// Medians over people who draw offices.
DrawingStatistics median_statistics(int drawings) {
  std::vector<double> ratios;
  std::vector<double> spans_rad;
  std::vector<double> anisotropies;
  std::vector<double> largest_anisotropies;
  std::array<std::vector<double>, 4> changes_m;
  for (int i = 0; i < drawings; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    Rng rng = make_rng(seed, 1);
    const Building building = building_from_plan(plan(BuildingKind::Office, seed));
    const Drive drive = drive_through(building, {}, rng);
    if (drive.status != Drive::Status::Driven) {
      continue;
    }
    const Drawing drawing = draw(building.plan, human_person(), rng);
    const DrawingStatistics one =
        measure_drawing(drawn_places(drive.world_from_robot, drawing.sketch_from_world));
    ratios.push_back(one.scale_px_per_m.p95 / one.scale_px_per_m.p5);
    spans_rad.push_back(one.rotation_rad.p95 - one.rotation_rad.p5);
    anisotropies.push_back(one.anisotropy.median);
    largest_anisotropies.push_back(one.anisotropy.p95);
    for (std::size_t lag = 0; lag < 4; ++lag) {
      changes_m[lag].push_back(one.residual_change_m[lag]);
    }
  }
  DrawingStatistics medians;
  medians.scale_px_per_m = {1.0, 1.0, quantiles(ratios).median};
  medians.rotation_rad = {0.0, 0.0, quantiles(spans_rad).median};
  medians.anisotropy = {1.0, quantiles(anisotropies).median,
                        quantiles(largest_anisotropies).median};
  for (std::size_t lag = 0; lag < 4; ++lag) {
    medians.residual_change_m[lag] = quantiles(changes_m[lag]).median;
  }
  return medians;
}

// The bands are the spread of the real drawings in docs/results/simulator.md.
TEST(HumanPersonStatistical, DistortsAsMuchAsRealDrawings) {
  const DrawingStatistics medians = median_statistics(60);
  EXPECT_GT(medians.scale_px_per_m.p95, 1.9);
  EXPECT_LT(medians.scale_px_per_m.p95, 2.8);
  EXPECT_GT(deg_from_rad(medians.rotation_rad.p95), 35.0);
  EXPECT_LT(deg_from_rad(medians.rotation_rad.p95), 70.0);
  EXPECT_GT(medians.anisotropy.median, 1.6);
  EXPECT_LT(medians.anisotropy.median, 2.3);
  EXPECT_GT(medians.anisotropy.p95, 3.7);
  EXPECT_LT(medians.anisotropy.p95, 6.5);
  EXPECT_NEAR(medians.residual_change_m[0], 0.5, 0.12);
  EXPECT_NEAR(medians.residual_change_m[1], 0.8, 0.2);
  EXPECT_NEAR(medians.residual_change_m[2], 1.5, 0.3);
  EXPECT_NEAR(medians.residual_change_m[3], 2.0, 0.4);
}

}  // namespace
}  // namespace sketchloc

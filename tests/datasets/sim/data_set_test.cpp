#include "datasets/sim/data_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

DataSetParams short_drive(BuildingKind kind) {
  DataSetParams params{.building = kind};
  params.drive.length_m = 20.0;
  return params;
}

class DataSets : public ::testing::TestWithParam<BuildingKind> {};

TEST_P(DataSets, TheSameSeedGivesTheSameBits) {
  const DataSet first = generate_data_set(short_drive(GetParam()), 7);
  const DataSet second = generate_data_set(short_drive(GetParam()), 7);
  EXPECT_EQ(first.drawing.sketch.occupied, second.drawing.sketch.occupied);
  ASSERT_EQ(first.run.steps.size(), second.run.steps.size());
  for (std::size_t i = 0; i < first.run.steps.size(); ++i) {
    EXPECT_EQ(first.run.steps[i].scan.ranges_m, second.run.steps[i].scan.ranges_m);
  }
}

TEST_P(DataSets, OtherSeedsGiveOtherDrawings) {
  const DataSet first = generate_data_set(short_drive(GetParam()), 7);
  const DataSet second = generate_data_set(short_drive(GetParam()), 8);
  EXPECT_NE(first.drawing.sketch.occupied, second.drawing.sketch.occupied);
}

TEST_P(DataSets, EveryStepHasAReferenceInsideTheDrawing) {
  const DataSet data_set = generate_data_set(short_drive(GetParam()), 3);
  ASSERT_EQ(data_set.reference.poses.size(), data_set.run.steps.size());
  for (const ReferencePose& pose : data_set.reference.poses) {
    EXPECT_TRUE(pose.scored);
  }
}

/// A hall with walls that count as inner ones.
Building hall() {
  Grid<std::uint8_t> occupied(200, 200, 1);
  for (int row = 10; row < 190; ++row) {
    std::ranges::fill(occupied.row(row).subspan(10, 180), std::uint8_t{0});
  }
  Rng rng = make_rng(1);
  return building_from_map(occupied, 0.05, rng);
}

TEST(DataSetInBuilding, SaysWhyThereIsNone) {
  using Status = DataSetInBuilding::Status;
  const DataSetParams params = short_drive(BuildingKind::Office);
  Rng rng = make_rng(1);
  const Building solid = building_from_map(Grid<std::uint8_t>(50, 50, 1), 0.05, rng);
  EXPECT_EQ(generate_data_set(hall(), params, 1).status, Status::Made);
  EXPECT_EQ(generate_data_set(solid, params, 1).status, Status::NoFreeSpace);
  DataSetParams lazy = params;
  lazy.person->pen.left_out_share = 1.0;
  EXPECT_EQ(generate_data_set(hall(), lazy, 1).status, Status::NothingToDraw);
  DataSetParams wide = params;
  wide.drive.robot_radius_m = 4.2;
  EXPECT_EQ(generate_data_set(hall(), wide, 1).status, Status::Confined);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, DataSets,
                         ::testing::Values(BuildingKind::Home, BuildingKind::Office,
                                           BuildingKind::Warehouse));

}  // namespace
}  // namespace sketchloc

#include "datasets/sim/data_set.hpp"

#include <gtest/gtest.h>

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

INSTANTIATE_TEST_SUITE_P(AllKinds, DataSets,
                         ::testing::Values(BuildingKind::Home, BuildingKind::Office,
                                           BuildingKind::Warehouse));

}  // namespace
}  // namespace sketchloc

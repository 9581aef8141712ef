#include "topology/recovered_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/aisle_drive.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::aisle_drive;
using testing::AisleDrive;
using testing::mean_distance_m;

TEST(RecoverRun, StraightensASteadyDriftThatGoesRound) {
  Rng rng = make_rng(1);
  const AisleDrive drive = aisle_drive({.drift_deg_per_m = 1.5}, rng);
  EXPECT_GT(mean_distance_m(drive.world_from_robot, drive.odom_from_robot), 3.0);
  const RecoveredRun run = recover_run(drive.odom_from_robot, drive.labels);
  EXPECT_LT(mean_distance_m(drive.world_from_robot, run.manhattan_from_robot), 0.3);
}

TEST(RecoverRun, LaysTheAxesAlongTheWallsNearestToTheOdometry) {
  Rng rng = make_rng(1);
  const AisleDrive drive = aisle_drive({.first_heading_deg = 25.0}, rng);
  const RecoveredRun run = recover_run(drive.odom_from_robot, drive.labels);
  for (std::size_t i = 0; i < drive.world_from_robot.size(); i += 50) {
    EXPECT_THAT(run.manhattan_from_robot[i], testing::IsNear(drive.world_from_robot[i], 0.6));
  }
}

TEST(RecoverRunStatistical, LoopsLowerTheErrorOfManyRuns) {
  double without_m = 0.0;
  double with_m = 0.0;
  std::size_t wrong = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng = make_rng(seed);
    const AisleDrive drive = aisle_drive({.drift_deg_per_m = 0.7, .turn_error_deg = 4.0}, rng);
    const RecoveredRun bare =
        recover_run(drive.odom_from_robot, drive.labels, {}, TopologyStage::Manhattan);
    const RecoveredRun run = recover_run(drive.odom_from_robot, drive.labels);
    without_m += mean_distance_m(drive.world_from_robot, bare.manhattan_from_robot) / 20.0;
    with_m += mean_distance_m(drive.world_from_robot, run.manhattan_from_robot) / 20.0;
    for (const SamePlacePair& pair : run.pairs) {
      const Se2& a = drive.world_from_robot[pair.beside.front().earlier];
      const Se2& b = drive.world_from_robot[pair.beside.front().later];
      wrong += (a.translation() - b.translation()).norm() > 1.5 ? 1U : 0U;
    }
  }
  EXPECT_LT(with_m, without_m);
  EXPECT_LT(with_m, 0.6);
  EXPECT_LE(wrong, 5U);
}

TEST(RecoverRun, GivesBackTheOdometryWhereNothingIsUsed) {
  Rng rng = make_rng(1);
  const AisleDrive drive = aisle_drive({.drift_deg_per_m = 1.0}, rng);
  const RecoveredRun run =
      recover_run(drive.odom_from_robot, drive.labels, {}, TopologyStage::Unoptimised);
  EXPECT_THAT(run.manhattan_from_robot.back(),
              testing::IsNear(drive.odom_from_robot.back(), 1e-12));
}

TEST(RecoverRun, SnapsPiecesOntoWalls) {
  Rng rng = make_rng(1);
  const AisleDrive drive = aisle_drive({.drift_deg_per_m = 1.0}, rng);
  const RecoveredRun run =
      recover_run(drive.odom_from_robot, drive.labels, {}, TopologyStage::Snap);
  EXPECT_TRUE(run.graph.vertices.empty());
  EXPECT_LT(mean_distance_m(drive.world_from_robot, run.manhattan_from_robot), 0.5);
}

TEST(RecoverRun, TakesRunsOfNoPoseAndOfOne) {
  EXPECT_TRUE(recover_run({}, {}).manhattan_from_robot.empty());
  const std::vector<Se2> one = {Se2::from_xy_yaw(1.0, 2.0, 0.5)};
  const std::vector<PlaceLabel> label = {PlaceLabel::Corridor};
  const RecoveredRun run = recover_run(one, label);
  ASSERT_EQ(run.manhattan_from_robot.size(), 1U);
  EXPECT_THAT(run.manhattan_from_robot[0], testing::IsNear(one[0], 1e-6));
}

TEST(RecoverRun, RefusesParametersOutOfRangeByName) {
  try {
    recover_run({}, {}, {.drift = {.wander_deg = -1.0}});
    FAIL() << "no complaint";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("drift.wander_deg"), std::string::npos);
  }
}

}  // namespace
}  // namespace sketchloc

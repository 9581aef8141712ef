#include "eval/place_pairs.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "datasets/sim/drive.hpp"
#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/plan_generators.hpp"
#include "tests/support/no_registrations.hpp"

namespace sketchloc {
namespace {

/// A drive through a warehouse whose odometry is right.
Run drive_through_warehouse() {
  Rng rng = make_rng(5);
  const Building building = building_from_plan(make_warehouse(rng));
  const Drive drive = drive_through(building, {.length_m = 200.0}, rng);
  const LidarSimulator lidar(building.map, {});
  Run run;
  for (const Stamped<Se2>& pose : drive.world_from_robot) {
    run.steps.push_back(
        {.scan = lidar.scan(pose.pose, pose.time_s, rng), .odom_from_robot = pose.pose});
  }
  return run;
}

TEST(PlacePairs, JoinKeyframesThatLieBesideEachOther) {
  const sketchloc::Run run = drive_through_warehouse();
  const std::vector<Keyframe> keyframes = testing::keyframes_of(run.steps);
  const PlacePairParams params;
  const std::vector<KeyframePair> pairs = place_pairs(run, keyframes, params);
  ASSERT_GT(pairs.size(), 10U);
  constexpr double kHalfAisle_m = 1.6;  // aisles and the racks between them are 3.2 m at least
  int right = 0;
  for (const KeyframePair& pair : pairs) {
    ASSERT_LT(pair.earlier, pair.later);
    ASSERT_LT(pair.later, keyframes.size());
    EXPECT_GT(pair.probability, 0.0);
    EXPECT_LE(pair.probability, params.max_probability);
    const Se2 truth =
        keyframes[pair.earlier].odom_from_robot.inverse() * keyframes[pair.later].odom_from_robot;
    right +=
        (truth.translation() - pair.earlier_from_later.translation()).norm() < kHalfAisle_m ? 1 : 0;
  }
  EXPECT_GT(right, 0.75 * static_cast<double>(pairs.size()));
}

TEST(PlacePairs, ThereAreNoneWithoutAWay) {
  sketchloc::Run run = drive_through_warehouse();
  run.steps.resize(3);
  EXPECT_TRUE(place_pairs(run, testing::keyframes_of(run.steps)).empty());
}

TEST(PlacePairs, RefuseParametersOutOfRange) {
  EXPECT_THROW(validate(PlacePairParams{.max_probability = 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

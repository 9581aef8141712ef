#include "topology/scan_closure.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/place_labels.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

/// A hall with an aisle between two rows of racks of different lengths.
Building hall(double rack_m) {
  FloorPlan plan;
  plan.rooms.push_back({.use = Room::Use::Hall, .box_in_world = {{0.0, 0.0}, {20.0, 10.0}}});
  plan.walls = {{.from_in_world = {0.0, 0.0}, .to_in_world = {20.0, 0.0}},
                {.from_in_world = {20.0, 0.0}, .to_in_world = {20.0, 10.0}},
                {.from_in_world = {20.0, 10.0}, .to_in_world = {0.0, 10.0}},
                {.from_in_world = {0.0, 10.0}, .to_in_world = {0.0, 0.0}}};
  plan.furniture = {
      {.centre_in_world = {10.0, 3.0}, .half_size_m = {rack_m, 0.5}, .structural = true},
      {.centre_in_world = {9.0, 7.0}, .half_size_m = {0.8 * rack_m, 0.5}, .structural = true}};
  return building_from_plan(plan);
}

/// Two passes along the aisle: the first one where it was, the second one believed to be off.
struct Passes {
  std::vector<Scan> scans;
  std::vector<Se2> poses;
  Travel travel;
};

Passes two_passes(const Building& first, const Building& second, const Se2& off) {
  Rng rng = make_rng(4);
  Passes passes;
  for (const Building* building : {&first, &second}) {
    const LidarSimulator lidar(building->map, {});
    for (int i = 0; i < 16; ++i) {
      const Se2 world_from_robot = Se2::from_xy_yaw(3.0 + 0.5 * i, 5.0, 0.0);
      passes.scans.push_back(lidar.scan(world_from_robot, 0.0, rng));
      passes.poses.push_back(building == &second ? off * world_from_robot : world_from_robot);
    }
  }
  passes.travel = travel_of(passes.poses);
  return passes;
}

const SamePlacePair kPair{.earlier = 0, .later = 1, .beside = {{.earlier = 8, .later = 24}}};

std::optional<GraphEdge> closure(const Passes& passes, const ScanClosureParams& params = {}) {
  return close_by_scans({passes.scans, passes.poses, passes.travel}, kPair, params);
}

TEST(ScanClosure, TellsHowTwoPassesOfAPlaceLie) {
  const Building building = hall(5.0);
  const Passes passes =
      two_passes(building, building, Se2::from_xy_yaw(0.2, 0.3, rad_from_deg(1.0)));
  const std::optional<GraphEdge> edge = closure(passes);
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->first, 8U);
  EXPECT_EQ(edge->second, 24U);
  EXPECT_TRUE(edge->may_be_wrong);
  // In truth both poses are one.
  EXPECT_NEAR(edge->measured.x, 0.0, 0.1);
  EXPECT_NEAR(edge->measured.y, 0.0, 0.1);
  EXPECT_NEAR(edge->measured.yaw_rad, 0.0, rad_from_deg(2.0));
}

TEST(ScanClosure, IsNoSurerThanSubmapsCanBe) {
  const Building building = hall(5.0);
  const std::optional<GraphEdge> edge = closure(two_passes(building, building, Se2()));
  ASSERT_TRUE(edge);
  const ScanClosureParams params;
  EXPECT_LE(edge->information(0, 0), 1.001 / (params.least_sigma_m * params.least_sigma_m));
  EXPECT_LE(edge->information(1, 1), 1.001 / (params.least_sigma_m * params.least_sigma_m));
  EXPECT_GT(edge->information(1, 1), 1.0);
}

TEST(ScanClosure, ThereIsNoneWhereTheScansDoNotFit) {
  EXPECT_FALSE(closure(two_passes(hall(6.0), hall(1.0), Se2())));
}

TEST(ScanClosure, ThereIsNoneWithoutAnythingToSee) {
  const Building building = hall(5.0);
  Passes passes = two_passes(building, building, Se2());
  for (Scan& scan : passes.scans) {
    scan.ranges_m.assign(scan.ranges_m.size(), static_cast<float>(scan.max_range_m));
  }
  EXPECT_FALSE(closure(passes));
}

TEST(ScanClosure, RefusesParametersOutOfRange) {
  EXPECT_THROW(validate(ScanClosureParams{.search_radius_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(ScanClosureParams{.least_matched_share = 1.5}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "datasets/sim/plan_generators.hpp"

#include <gtest/gtest.h>

#include "datasets/sim/building.hpp"
#include "datasets/sim/detail/plan_builder.hpp"
#include "datasets/sim/detail/route_planner.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSeeds = 6;

class Plans : public ::testing::TestWithParam<BuildingKind> {
 protected:
  static FloorPlan plan(std::uint64_t seed) {
    Rng rng = make_rng(seed);
    return make_plan(GetParam(), rng);
  }
};

TEST_P(Plans, HaveRoomsThatDoNotOverlap) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<Room> rooms = plan(seed).rooms;
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const PlaneBox& a = rooms[i].box_in_world;
        const PlaneBox& b = rooms[j].box_in_world;
        const Eigen::Vector2d overlap = a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low);
        EXPECT_LT(overlap.minCoeff(), 1e-9);
      }
    }
  }
}

TEST_P(Plans, LetARobotIntoNearlyEveryRoom) {
  std::size_t rooms = 0;
  std::size_t reachable = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const FloorPlan floor_plan = plan(seed);
    const detail::RoutePlanner planner(rasterise(floor_plan), 0.22);
    for (const Room& room : floor_plan.rooms) {
      ++rooms;
      reachable += planner.standing_places(room.box_in_world).empty() ? 0 : 1;
    }
  }
  EXPECT_GT(static_cast<double>(reachable), 0.9 * static_cast<double>(rooms));
}

TEST_P(Plans, HaveDoorsBetweenTheEndsOfWalls) {
  const FloorPlan floor_plan = plan(1);
  EXPECT_FALSE(floor_plan.doors.empty());
  for (const Door& door : floor_plan.doors) {
    int jambs = 0;
    for (const Wall& wall : floor_plan.walls) {
      jambs += wall.to_in_world == door.from_in_world || wall.from_in_world == door.to_in_world;
    }
    EXPECT_EQ(jambs, 2);
  }
}

TEST_P(Plans, DifferFromSeedToSeedButNotForOneSeed) {
  EXPECT_EQ(bounds_in_world(plan(3)).high, bounds_in_world(plan(3)).high);
  EXPECT_NE(bounds_in_world(plan(3)).high, bounds_in_world(plan(4)).high);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Plans,
                         ::testing::Values(BuildingKind::Home, BuildingKind::Office,
                                           BuildingKind::Warehouse));

TEST(Subdivide, FillsTheBoxWithRoomsOfTheWantedSize) {
  Rng rng = make_rng(1);
  double area_m2 = 0.0;
  for (const Room& room : detail::subdivide({{0.0, 0.0}, {14.0, 9.0}}, 2.4, 20.0, rng)) {
    EXPECT_GE(room.box_in_world.size().minCoeff(), 2.4 - 1e-12);
    EXPECT_LE(room.box_in_world.size().prod(), 1.2 * 20.0);
    area_m2 += room.box_in_world.size().prod();
  }
  EXPECT_NEAR(area_m2, 14.0 * 9.0, 1e-9);
}

TEST(RandomCuts, MeetBothEndsAndKeepRoughlyToTheLengths) {
  Rng rng = make_rng(2);
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> cuts = detail::random_cuts(1.0, 24.0, 3.0, 6.0, rng);
    EXPECT_EQ(cuts.front(), 1.0);
    EXPECT_EQ(cuts.back(), 24.0);
    for (std::size_t j = 1; j < cuts.size(); ++j) {
      EXPECT_GT(cuts[j] - cuts[j - 1], 3.0 * 0.75);
      EXPECT_LT(cuts[j] - cuts[j - 1], 6.0 / 0.75);
    }
  }
}

TEST(PlanFromRooms, OpensAWayToEveryRoomThatTheRuleForgets) {
  const std::vector<Room> row = {{.box_in_world = {{0.0, 0.0}, {3.0, 3.0}}},
                                 {.box_in_world = {{3.0, 0.0}, {6.0, 3.0}}},
                                 {.box_in_world = {{6.0, 0.0}, {9.0, 3.0}}}};
  const auto walls_only = [](const Room&, const Room&) { return detail::Passage::Wall; };
  Rng rng = make_rng(1);
  EXPECT_EQ(detail::plan_from_rooms(row, walls_only, {}, rng).doors.size(), 2U);
}

}  // namespace
}  // namespace sketchloc

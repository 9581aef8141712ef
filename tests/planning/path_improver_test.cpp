#include "planning/path_improver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planning/house.hpp"

namespace sketchloc {
namespace {

FreeSpace space(Objective objective) {
  return {testing::house(), ScaleField(10.0), {.radius_m = 0.3, .sigmas = 0.0}, objective};
}

const PathPoints kDetour = {{20.0, 15.0}, {20.0, 60.0}, {60.5, 40.0}, {100.0, 60.0}, {100.0, 15.0}};

TEST(PathImprover, NeverMakesTheWayWorseOrBlocked) {
  const FreeSpace rooms = space(Objective::Balanced);
  PathImprover improver(rooms, kDetour, make_rng(3));
  double last_m = improver.cost_m();
  for (int i = 0; i < 3000; ++i) {
    const bool better = improver.improve();
    ASSERT_EQ(better, improver.cost_m() < last_m - 1e-12 * last_m) << i;
    last_m = improver.cost_m();
  }
  EXPECT_TRUE(is_free(improver.path_in_sketch(), rooms));
  EXPECT_NEAR(figures_of(improver.path_in_sketch(), rooms).cost_m, last_m, 1e-6 * last_m);
}

TEST(PathImprover, ComesCloseToTheShortestWay) {
  const FreeSpace rooms = space(Objective::Shortest);
  PathImprover improver(rooms, kDetour, make_rng(3));
  for (int i = 0; i < 20000; ++i) {
    improver.improve();
  }
  // past the lower jamb, whose px end at (61, 30), 3 px away
  const double corner_m = 0.1 * 2.0 * std::hypot(40.5, 33.0 - 15.0);
  EXPECT_NEAR(improver.cost_m(), corner_m, 0.02 * corner_m);
}

TEST(PathImprover, KeepsAWayOfOneSide) {
  const FreeSpace rooms = space(Objective::Shortest);
  PathImprover improver(rooms, {{20.0, 15.0}, {21.0, 15.0}}, make_rng(1));
  EXPECT_FALSE(improver.improve());
}

}  // namespace
}  // namespace sketchloc

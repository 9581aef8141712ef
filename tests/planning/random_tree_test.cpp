#include "planning/random_tree.hpp"

#include <gtest/gtest.h>

#include "tests/planning/house.hpp"

namespace sketchloc {
namespace {

FreeSpace space(int door_end = 50) {
  return {testing::house(door_end),
          ScaleField(10.0),
          {.radius_m = 0.3, .sigmas = 0.0},
          Objective::Shortest};
}

TEST(RandomTree, FindsAFreeWayFromStartToGoal) {
  const auto path = connect_trees(space(), {20.0, 15.0}, {100.0, 15.0}, 2000, 1);
  ASSERT_TRUE(path);
  EXPECT_TRUE(is_free(*path, space()));
  EXPECT_EQ(path->front(), Eigen::Vector2d(20.0, 15.0));
  EXPECT_EQ(path->back(), Eigen::Vector2d(100.0, 15.0));
}

TEST(RandomTree, GivesUpWhereThereIsNoWay) {
  EXPECT_FALSE(connect_trees(space(30), {20.0, 15.0}, {100.0, 15.0}, 300, 1));
}

TEST(RandomTree, GivesTheSameWayForTheSameSeed) {
  const auto ask = [](std::uint64_t seed) {
    return connect_trees(space(), {20.0, 15.0}, {100.0, 15.0}, 2000, seed);
  };
  EXPECT_EQ(ask(7), ask(7));
  EXPECT_NE(ask(7), ask(8));
}

}  // namespace
}  // namespace sketchloc

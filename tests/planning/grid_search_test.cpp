#include "planning/grid_search.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/planning/house.hpp"

namespace sketchloc {
namespace {

using Eigen::Vector2d;

FreeSpace space(int door_end) {
  return {testing::house(door_end),
          ScaleField(10.0),
          {.radius_m = 0.3, .sigmas = 0.0},
          Objective::Shortest};
}

TEST(GridSearch, FindsTheShortestWayOfEightNeighbours) {
  const FreeSpace room = space(50);
  const GridSearch found = search_grid(room, {10.5, 20.5}, {40.5, 30.5});
  ASSERT_EQ(found.status, GridSearch::Status::Found);
  EXPECT_NEAR(figures_of(found.path_in_sketch, room).length_m,
              0.1 * (20.0 + 10.0 * std::numbers::sqrt2), 1e-6);
  EXPECT_EQ(found.path_in_sketch.front(), Vector2d(10.5, 20.5));
  EXPECT_EQ(found.path_in_sketch.back(), Vector2d(40.5, 30.5));
}

TEST(GridSearch, GoesThroughTheDoor) {
  const FreeSpace rooms = space(50);
  const GridSearch found = search_grid(rooms, {20.0, 15.0}, {100.0, 15.0});
  ASSERT_EQ(found.status, GridSearch::Status::Found);
  EXPECT_TRUE(is_free(found.path_in_sketch, rooms));
}

TEST(GridSearch, SaysThatThereIsNoWay) {
  EXPECT_EQ(search_grid(space(30), {20.0, 15.0}, {100.0, 15.0}).status, GridSearch::Status::NoPath);
  EXPECT_EQ(search_grid(space(34), {20.0, 15.0}, {100.0, 15.0}).status,
            GridSearch::Status::NoPath);  // too narrow
  EXPECT_EQ(search_grid(space(50), {60.5, 15.0}, {100.0, 15.0}).status,
            GridSearch::Status::NoPath);  // begins on a wall
}

TEST(GridSearch, EndsWhenTheTimeIsOver) {
  EXPECT_EQ(
      search_grid(space(30), {20.0, 15.0}, {100.0, 15.0}, GridPrice::Length, [] { return true; })
          .status,
      GridSearch::Status::OutOfTime);
}

}  // namespace
}  // namespace sketchloc

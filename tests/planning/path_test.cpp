#include "planning/path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planning/house.hpp"

namespace sketchloc {
namespace {

using Eigen::Vector2d;
using ::testing::ElementsAre;

FreeSpace space() {
  return {
      testing::house(), ScaleField(10.0), {.radius_m = 0.5, .sigmas = 0.0}, Objective::Shortest};
}

TEST(Path, HasLengthAndClearanceInMetres) {
  const PathPoints path = {{30.5, 40.5}, {60.5, 40.5}, {60.5, 45.5}};
  const PathFigures figures = figures_of(path, space());
  EXPECT_NEAR(figures.length_m, 3.5, 1e-6);
  EXPECT_NEAR(figures.least_clearance_m, 0.45, 1e-6);  // 5 px below the door's upper jamb
  EXPECT_GT(figures.mean_clearance_m, figures.least_clearance_m);
  EXPECT_EQ(figures_of(PathPoints{}, space()).length_m, 0.0);
}

TEST(Path, IsFreeIfAllOfItIs) {
  EXPECT_TRUE(is_free(PathPoints{{30.0, 15.0}, {60.0, 40.0}, {90.0, 15.0}}, space()));
  EXPECT_FALSE(is_free(PathPoints{{30.0, 15.0}, {90.0, 15.0}}, space()));
  EXPECT_FALSE(is_free(PathPoints{}, space()));
}

TEST(Path, GoesOnFromTheNearestPlace) {
  const PathPoints path = {{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}};
  EXPECT_THAT(rest_of(path, {6.0, 1.0}), ElementsAre(Vector2d(6.0, 1.0), Vector2d(6.0, 0.0),
                                                     Vector2d(10.0, 0.0), Vector2d(10.0, 10.0)));
  EXPECT_TRUE(rest_of(PathPoints{}, {6.0, 1.0}).empty());
}

TEST(Path, KeepsItsCornersOnly) {
  const PathPoints path = {{0.5, 0.5}, {1.5, 1.5}, {2.5, 2.5}, {3.5, 2.5}, {4.5, 2.5}};
  EXPECT_THAT(corners_of(path),
              ElementsAre(Vector2d(0.5, 0.5), Vector2d(2.5, 2.5), Vector2d(4.5, 2.5)));
}

TEST(Path, IsPulledStraightAroundWalls) {
  const PathPoints path = {{20.0, 15.0}, {20.0, 60.0},  {50.0, 60.0}, {60.5, 40.0},
                           {70.0, 60.0}, {100.0, 60.0}, {100.0, 15.0}};
  const PathPoints pulled = pulled_straight(path, space());
  EXPECT_TRUE(is_free(pulled, space()));
  EXPECT_LT(figures_of(pulled, space()).length_m, 0.8 * figures_of(path, space()).length_m);
  EXPECT_EQ(pulled.front(), path.front());
  EXPECT_EQ(pulled.back(), path.back());
}

}  // namespace
}  // namespace sketchloc

#include "datasets/sim/detail/pen.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sketchloc::detail {
namespace {

Wall wall(double from_x, double from_y, double to_x, double to_y) {
  return {.from_in_world = {from_x, from_y}, .to_in_world = {to_x, to_y}};
}

const PenParams kSteadyPen = {.wobble_px = 0.0,
                              .end_error_px = 0.0,
                              .rounding_px = 0.0,
                              .thick_wall_share = 0.0,
                              .left_out_share = 0.0,
                              .shut_door_share = 0.0,
                              .door_log_sigma = 0.0,
                              .furniture_share = 0.0};

TEST(ChainWalls, DrawsWallsThatGoStraightOnInOneStroke) {
  Rng rng = make_rng(1);
  const std::vector<Wall> walls = {wall(0, 0, 2, 0), wall(4, 0, 2, 0), wall(2, 0, 2, 3)};
  const std::vector<Stroke> strokes = chain_walls(walls, 0.0, rng);
  ASSERT_EQ(strokes.size(), 2U);
  EXPECT_NEAR(length(strokes[0]) + length(strokes[1]), 7.0, 1e-12);
  EXPECT_NEAR(std::max(length(strokes[0]), length(strokes[1])), 4.0, 1e-12);
}

TEST(ChainWalls, GoesRoundAllCornersOfARoomWithoutLiftingThePen) {
  Rng rng = make_rng(1);
  const std::vector<Wall> walls = {wall(0, 0, 2, 0), wall(2, 0, 2, 2), wall(0, 2, 2, 2),
                                   wall(0, 2, 0, 0)};
  const std::vector<Stroke> strokes = chain_walls(walls, 1.0, rng);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].front(), strokes[0].back());
  EXPECT_NEAR(length(strokes[0]), 8.0, 1e-12);
  EXPECT_EQ(chain_walls(walls, 0.0, rng).size(), 4U);
}

TEST(ChainWalls, HasNothingToDrawWithoutWalls) {
  Rng rng = make_rng(1);
  EXPECT_TRUE(chain_walls({}, 0.5, rng).empty());
}

/// A wall with a door and a desk.
FloorPlan small_plan() {
  FloorPlan plan;
  plan.walls = {wall(0, 0, 2, 0), wall(3, 0, 6, 0)};
  plan.doors = {{{2.0, 0.0}, {3.0, 0.0}}};
  plan.furniture = {{.centre_in_world = {1.0, 3.0}, .half_size_m = {0.5, 0.5}}};
  return plan;
}

double total_length(const std::vector<Stroke>& strokes) {
  double sum = 0.0;
  for (const Stroke& stroke : strokes) {
    sum += length(stroke);
  }
  return sum;
}

TEST(ChooseStrokes, LeavesDoorsOpenAndFurnitureOut) {
  Rng rng = make_rng(1);
  EXPECT_NEAR(total_length(choose_strokes(small_plan(), kSteadyPen, rng)), 5.0, 1e-9);
}

TEST(ChooseStrokes, ShutsDoorsAndDrawsFurnitureIfThePersonDoes) {
  PenParams pen = kSteadyPen;
  pen.shut_door_share = 1.0;
  pen.furniture_share = 1.0;
  Rng rng = make_rng(1);
  EXPECT_NEAR(total_length(choose_strokes(small_plan(), pen, rng)), 6.0 + 4.0, 1e-9);
}

TEST(ChooseStrokes, AlwaysDrawsWhatBelongsToTheBuilding) {
  FloorPlan plan = small_plan();
  plan.furniture[0].structural = true;
  Rng rng = make_rng(1);
  EXPECT_NEAR(total_length(choose_strokes(plan, kSteadyPen, rng)), 5.0 + 4.0, 1e-9);
}

TEST(ChooseStrokes, DrawsThickWallsAsOutlines) {
  PenParams pen = kSteadyPen;
  pen.thick_wall_share = 1.0;
  Rng rng = make_rng(1);
  EXPECT_GT(total_length(choose_strokes(small_plan(), pen, rng)), 2.0 * 5.0);
}

TEST(DrawnByHand, KeepsToTheLineWithASteadyHand) {
  Rng rng = make_rng(1);
  const Stroke drawn = drawn_by_hand({{10.0, 10.0}, {100.0, 10.0}, {100.0, 60.0}}, kSteadyPen, rng);
  EXPECT_EQ(drawn.front(), Eigen::Vector2d(10.0, 10.0));
  EXPECT_EQ(drawn.back(), Eigen::Vector2d(100.0, 60.0));
  EXPECT_NEAR(length(drawn), 140.0, 1e-9);
}

TEST(DrawnByHand, CutsCornersWhenRounding) {
  PenParams pen = kSteadyPen;
  pen.rounding_px = 10.0;
  Rng rng = make_rng(1);
  const Stroke drawn = drawn_by_hand({{10.0, 10.0}, {100.0, 10.0}, {100.0, 60.0}}, pen, rng);
  EXPECT_LT(length(drawn), 139.5);
  for (const Eigen::Vector2d& point : drawn) {
    EXPECT_LE(point.x(), 100.0 + 1e-9);
    EXPECT_GE(point.y(), 10.0 - 1e-9);
  }
}

TEST(DrawnByHandStatistical, WobblesSidewaysByTheGivenAmount) {
  PenParams pen = kSteadyPen;
  pen.wobble_px = 2.0;
  Rng rng = make_rng(1);
  double sum = 0.0;
  double count = 0.0;
  for (int i = 0; i < 200; ++i) {
    for (const Eigen::Vector2d& point : drawn_by_hand({{0.0, 0.0}, {350.0, 0.0}}, pen, rng)) {
      sum += point.y() * point.y();
      count += 1.0;
    }
  }
  // Cosine blends between independent values have 3/4 of their variance on average; the tremor
  // adds a sixteenth of it.
  const double expected = 2.0 * 2.0 * 0.75 * (1.0 + 1.0 / 16.0);
  const double independent = 200.0 * 350.0 / pen.wobble_length_px;
  EXPECT_NEAR(sum / count / expected, 1.0, 5.0 * std::sqrt(2.0 / independent));
}

}  // namespace
}  // namespace sketchloc::detail

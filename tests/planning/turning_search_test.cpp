#include "planning/turning_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "motion/random.hpp"
#include "planning/planner.hpp"
#include "tests/planning/house.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr double kPxPerM = 10.0;

/// The largest one of circles through three places in a row, 1/px.
double most_curvature(const PathPoints& path) {
  double most = 0.0;
  for (std::size_t i = 2; i < path.size(); ++i) {
    const Vector2d a = path[i - 1] - path[i - 2];
    const Vector2d b = path[i] - path[i - 1];
    const double sides = a.norm() * b.norm() * (a + b).norm();
    most = std::max(most, sides > 1e-6 ? 2.0 * std::abs(a.x() * b.y() - a.y() * b.x()) / sides : 0);
  }
  return most;
}

Plan plan_of(const PlanQuery& query, double radius_m, const Sketch& sketch = testing::house()) {
  PlanParams params;
  params.body = {.radius_m = 0.3, .log_scale_sigma = 0.0};
  params.turning_radius_m = radius_m;
  params.improvements = 30;
  return Planner(sketch, ScaleField(kPxPerM), params).plan(query, 1);
}

TEST(TurningCurve, OfAnArcEndsWhereTheCircleDoes) {
  const TurningCurve quarter = arc_from({{5.0, 5.0}, 0.0}, 10.0 * pi / 2.0, 0.1);
  EXPECT_TRUE(quarter.back().place_in_sketch.isApprox(Vector2d(15.0, 15.0), 1e-12));
  EXPECT_NEAR(quarter.back().heading_rad, pi / 2.0, 1e-12);
  const TurningCurve line = arc_from({{5.0, 5.0}, pi / 2.0}, 7.0, 0.0);
  EXPECT_TRUE(line.back().place_in_sketch.isApprox(Vector2d(5.0, 12.0), 1e-12));
}

TEST(TurningCurve, ShortestIsAStraightLineOrAFullTurn) {
  const ShortestCurves shortest(10.0);
  EXPECT_NEAR(shortest.length_px({{0, 0}, 0.0}, {{30, 0}, 0.0}), 30.0, 1e-9);
  // turned round beside itself: half a circle
  EXPECT_NEAR(shortest.length_px({{0, 0}, 0.0}, {{0, 20}, pi}), 10.0 * pi, 1e-6);
  const TurningCurve half = shortest.between({{0, 0}, 0.0}, {{0, 20}, pi});
  EXPECT_LE(most_curvature(places_of(half)), 0.1 * 1.001);
}

class TurningSearchStatistical : public ::testing::TestWithParam<double> {};

/// Nothing is estimated here: what holds of every way holds of ways between random poses.
TEST_P(TurningSearchStatistical, NeverTurnsTighterAndCrossesNothing) {
  const double radius_m = GetParam();
  const Sketch house = testing::house();
  const FreeSpace space(house, ScaleField(kPxPerM), {.radius_m = 0.3, .log_scale_sigma = 0.0},
                        Objective::Balanced);
  Rng rng = make_rng(7, 0);
  const auto pose = [&](double low_px, double high_px) {
    const double x = uniform(low_px, high_px, rng);
    return DrawnPose{{x, uniform(20.0, 60.0, rng)}, uniform(-pi, pi, rng)};
  };
  int found = 0;
  for (int i = 0; i < 12; ++i) {
    const DrawnPose start = pose(20.0, 40.0);
    const DrawnPose goal = pose(80.0, 100.0);
    const Plan plan = plan_of({.start_in_sketch = start.place_in_sketch,
                               .goal_in_sketch = goal.place_in_sketch,
                               .start_heading_rad = start.heading_rad,
                               .goal_heading_rad = goal.heading_rad},
                              radius_m);
    if (plan.status == Plan::Status::TooTight) {
      continue;  // it looks at a wall
    }
    ++found;
    ASSERT_EQ(plan.status, Plan::Status::Found) << i;
    EXPECT_LE(most_curvature(plan.path_in_sketch), 1.001 / (radius_m * kPxPerM)) << i;
    EXPECT_TRUE(is_free(plan.path_in_sketch, space)) << i;
    EXPECT_EQ(plan.figures.crossings, 0);
    EXPECT_EQ(plan.path_in_sketch.front(), start.place_in_sketch);
    EXPECT_EQ(plan.path_in_sketch.back(), goal.place_in_sketch);
    const Vector2d first = plan.path_in_sketch[1] - plan.path_in_sketch[0];
    const double off_rad = std::atan2(first.y(), first.x()) - start.heading_rad;
    const double of_chord_rad = 0.5 * first.norm() / (radius_m * kPxPerM);
    EXPECT_LE(std::abs(std::remainder(off_rad, 2.0 * pi)), 1.05 * of_chord_rad) << i;
  }
  EXPECT_GE(found, 9);
}

INSTANTIATE_TEST_SUITE_P(Radii, TurningSearchStatistical, ::testing::Values(0.3, 0.6, 1.0, 1.5));

TEST(TurningSearch, IsNotMuchLongerThanTheShortestCurveInTheOpen) {
  const ShortestCurves shortest(10.0);
  const DrawnPose start{{30.0, 60.0}, pi};
  const DrawnPose goal{{150.0, 120.0}, pi / 2.0};
  const Sketch open = testing::sketch_of(Grid<std::uint8_t>(200, 200));
  const FreeSpace space(open, ScaleField(kPxPerM), {.radius_m = 0.1, .log_scale_sigma = 0.0},
                        Objective::Shortest);
  const TurningSearch found = search_turning(space, {.start_in_sketch = start.place_in_sketch,
                                                     .goal_in_sketch = goal.place_in_sketch,
                                                     .start_heading_rad = start.heading_rad,
                                                     .goal_heading_rad = goal.heading_rad,
                                                     .radius_px = 10.0});
  ASSERT_EQ(found.status, TurningSearch::Status::Found);
  const TurningCurve shorter = shortened(found.curve, space, {.radius_px = 10.0});
  const double bound_m = shortest.length_px(start, goal) / kPxPerM;
  EXPECT_GE(cost_m(places_of(found.curve), space), 0.999 * bound_m);
  EXPECT_LE(cost_m(places_of(found.curve), space), 1.1 * bound_m);
  EXPECT_LE(cost_m(places_of(shorter), space), 1.02 * bound_m);
}

TEST(TurningSearch, SaysWhetherTheRoomOrTheRadiusIsInTheWay) {
  const PlanQuery query = {.start_in_sketch = {20.0, 15.0}, .goal_in_sketch = {100.0, 15.0}};
  EXPECT_EQ(plan_of(query, 0.0).status, Plan::Status::Found);
  EXPECT_EQ(plan_of(query, 0.5).status, Plan::Status::Found);
  EXPECT_EQ(plan_of(query, 40.0).status, Plan::Status::TooTight);
  EXPECT_EQ(plan_of(query, 0.5, testing::house(30)).status, Plan::Status::NoPath);
}

TEST(TurningSearch, RadiusIsThatOfThePlaceWhereAMetreIsLargest) {
  PlanParams params;
  params.body = {.radius_m = 0.2, .log_scale_sigma = 0.0};
  params.turning_radius_m = 0.5;
  const std::vector<ScaleSample> samples = {{{20.0, 40.0}, 8.0}, {{100.0, 40.0}, 16.0}};
  const Planner planner(testing::house(), ScaleField(120, 80, samples), params);
  const Plan plan = planner.plan(
      {.start_in_sketch = {25.0, 20.0}, .goal_in_sketch = {90.0, 20.0}, .start_heading_rad = pi},
      1);
  ASSERT_TRUE(plan.found());
  const double largest_px_per_m = 1.0 / planner.space().least_m_per_px();
  EXPECT_GT(largest_px_per_m, 12.0);
  EXPECT_LE(most_curvature(plan.path_in_sketch), 1.001 / (0.5 * largest_px_per_m));
}

TEST(TurningSearch, OfTheSameSeedIsTheSame) {
  const PlanQuery query = {.start_in_sketch = {20.0, 15.0}, .goal_in_sketch = {100.0, 15.0}};
  EXPECT_EQ(plan_of(query, 0.8).path_in_sketch, plan_of(query, 0.8).path_in_sketch);
}

}  // namespace
}  // namespace sketchloc

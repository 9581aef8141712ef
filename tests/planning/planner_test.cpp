#include "planning/planner.hpp"

#include <gtest/gtest.h>

#include "motion/random.hpp"
#include "tests/planning/house.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

using Eigen::Vector2d;
using Status = Plan::Status;

PlanParams params() {
  PlanParams params;
  params.body = {.radius_m = 0.3, .log_scale_sigma = 0.0};
  params.improvements = 2000;
  return params;
}

Planner planner(int door_end, const PlanParams& of = params()) {
  return {testing::house(door_end), ScaleField(10.0), of};
}

const PlanQuery kAcross = {.start_in_sketch = {20.0, 15.0}, .goal_in_sketch = {100.0, 15.0}};

TEST(Planner, FindsAWayThroughTheDoorThatKeepsClear) {
  const Plan plan = planner(50).plan(kAcross, 1);
  ASSERT_EQ(plan.status, Status::Found);
  EXPECT_EQ(plan.path_in_sketch.front(), kAcross.start_in_sketch);
  EXPECT_EQ(plan.path_in_sketch.back(), kAcross.goal_in_sketch);
  EXPECT_GE(plan.figures.least_clearance_m, 0.3);
  EXPECT_EQ(plan.figures.crossings, 0);
}

TEST(Planner, GoesThroughTheMiddleWhereSafetyCounts) {
  PlanParams shortest = params();
  shortest.objective = Objective::Shortest;
  PlanParams safest = params();
  safest.objective = Objective::Safest;
  const PathFigures near = planner(50, shortest).plan(kAcross, 1).figures;
  const PathFigures far = planner(50, safest).plan(kAcross, 1).figures;
  EXPECT_LT(near.length_m, far.length_m);
  EXPECT_GT(far.least_clearance_m, near.least_clearance_m + 0.3);
}

TEST(Planner, SaysWhatIsWrongWithTheEnds) {
  const Planner rooms = planner(50);
  const auto status = [&](const Vector2d& start, const Vector2d& goal) {
    return rooms.plan({.start_in_sketch = start, .goal_in_sketch = goal}, 1).status;
  };
  EXPECT_EQ(status({-5.0, 15.0}, {100.0, 15.0}), Status::StartOutside);
  EXPECT_EQ(status({60.5, 15.0}, {100.0, 15.0}), Status::StartBlocked);
  EXPECT_EQ(status({20.0, 15.0}, {100.0, 300.0}), Status::GoalOutside);
  EXPECT_EQ(status({20.0, 15.0}, {60.5, 15.0}), Status::GoalBlocked);
  const Plan blocked = rooms.plan({.start_in_sketch = {58.5, 15.5}, .goal_in_sketch = {9, 9}}, 1);
  ASSERT_TRUE(blocked.nearest_free_in_sketch);
  EXPECT_LT((*blocked.nearest_free_in_sketch - Vector2d(58.5, 15.5)).norm(), 4.0);
}

TEST(Planner, MovesBlockedEndsAsFarAsAllowed) {
  PlanParams moving = params();
  moving.move_ends_m = 0.5;
  const Plan plan =
      planner(50, moving)
          .plan({.start_in_sketch = {58.5, 15.5}, .goal_in_sketch = {100.0, 15.0}}, 1);
  ASSERT_EQ(plan.status, Status::Found);
  EXPECT_LT((plan.path_in_sketch.front() - Vector2d(58.5, 15.5)).norm(), 5.0);
}

TEST(Planner, KnowsThatThereIsNoWay) {
  EXPECT_EQ(planner(30).plan(kAcross, 1).status, Status::NoPath);
  EXPECT_EQ(planner(35).plan(kAcross, 1).status, Status::NoPath);  // a gap of 0.5 m
}

TEST(Planner, CrossesStrokesWhereThatIsAllowedAndNothingElseIsLeft) {
  PlanParams crossing = params();
  crossing.crossing_cost_m = 5.0;
  const Plan shut = planner(30, crossing).plan(kAcross, 1);
  EXPECT_EQ(shut.status, Status::FoundAcross);
  EXPECT_EQ(shut.figures.crossings, 1);
  EXPECT_EQ(planner(50, crossing).plan(kAcross, 1).status, Status::Found);
}

TEST(Planner, RunsOutOfTimeBeforeTheFirstWay) {
  PlanParams no_trees = params();
  no_trees.tree_nodes = 0;
  const Plan plan = planner(50, no_trees).plan(kAcross, 1, {.out_of_time = [] { return true; }});
  EXPECT_EQ(plan.status, Status::OutOfTime);
}

TEST(Planner, TellsOfBetterAndBetterWays) {
  std::vector<double> costs_m;
  const Plan plan = planner(50).plan(
      kAcross, 1, {.found = [&](const Plan& better) { costs_m.push_back(better.figures.cost_m); }});
  ASSERT_FALSE(costs_m.empty());
  EXPECT_TRUE(std::ranges::is_sorted(costs_m, std::greater<>()));
  EXPECT_LE(plan.figures.cost_m, costs_m.back());
}

TEST(Planner, GoesOnFromTheLastWay) {
  const Planner rooms = planner(50);
  PlanQuery again = kAcross;
  again.last_path_in_sketch = rooms.plan(kAcross, 1).path_in_sketch;
  again.start_in_sketch = {25.0, 20.0};
  std::optional<Plan::Source> first;
  rooms.plan(again, 2, {.found = [&](const Plan& plan) { first = first.value_or(plan.source); }});
  EXPECT_EQ(first, Plan::Source::LastPath);
}

TEST(Planner, GivesTheSameWayForTheSameSeed) {
  const Planner rooms = planner(50);
  const Planner same = planner(50);
  EXPECT_EQ(rooms.plan(kAcross, 4).path_in_sketch, same.plan(kAcross, 4).path_in_sketch);
  EXPECT_EQ(rooms.plan(kAcross, 4).path_in_sketch, rooms.plan(kAcross, 4).path_in_sketch);
}

TEST(Planner, FindsAWayWhereverTheGridHasOne) {
  const Sketch sketch = testing::sketch_of(testing::rooms(160, 160, 40, 9));
  const Planner rooms(sketch, ScaleField(10.0), params());
  Rng rng = make_rng(11);
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector2d start(uniform(0.0, 160.0, rng), uniform(0.0, 160.0, rng));
    const PlanQuery query{.start_in_sketch = start,
                          .goal_in_sketch = {uniform(0.0, 160.0, rng), uniform(0.0, 160.0, rng)}};
    const bool expected =
        search_grid(rooms.space(), start, query.goal_in_sketch).status == GridSearch::Status::Found;
    EXPECT_EQ(rooms.plan(query, 1).found(), expected) << start.transpose();
    found += expected ? 1 : 0;
  }
  EXPECT_GT(found, 10);
}

TEST(Planner, RefusesParametersOutOfRange) {
  PlanParams wrong = params();
  wrong.crossing_cost_m = 0.0;
  EXPECT_THROW(planner(50, wrong), std::invalid_argument);
  wrong = params();
  wrong.body.radius_m = -1.0;
  EXPECT_THROW(planner(50, wrong), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

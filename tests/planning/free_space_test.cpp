#include "planning/free_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/random.hpp"
#include "tests/planning/house.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

using Eigen::Vector2d;

constexpr BodyParams kExact = {.radius_m = 0.5, .log_scale_sigma = 0.0, .sigmas = 0.0};

FreeSpace space_of(const Sketch& sketch, const BodyParams& body = kExact,
                   Objective objective = Objective::Shortest) {
  return {sketch, ScaleField(10.0), body, objective};
}

TEST(FreeSpace, KeepsTheBodyClearOfStrokesInMetres) {
  const FreeSpace space = space_of(testing::house());
  // the wall's px reach from x = 60 to 61; the robot has 5 px
  EXPECT_TRUE(space.is_free(Vector2d(54.5, 15.0)));
  EXPECT_FALSE(space.is_free(Vector2d(56.5, 15.0)));
  EXPECT_NEAR(space.clearance_m({50.5, 15.5}), 0.95, 1e-6);
}

TEST(FreeSpace, AddsWhatIsNotKnownToTheBody) {
  const BodyParams body = {
      .radius_m = 0.2, .pose_sigma_m = 0.1, .log_scale_sigma = std::log(1.5), .sigmas = 2.0};
  EXPECT_NEAR(body.clear_m(), 0.2 * 2.25 + 0.2, 1e-12);
}

TEST(FreeSpace, BeyondTheDrawingNothingIsFree) {
  const FreeSpace space = space_of(testing::house());
  EXPECT_FALSE(space.contains({-0.1, 5.0}));
  EXPECT_FALSE(space.is_free(Vector2d(-0.1, 5.0)));
  EXPECT_FALSE(space.is_free(Vector2d(20.0, 20.0), Vector2d(500.0, 20.0)));
  EXPECT_EQ(space.clearance_m({1e9, 1e9}), 0.0);
}

TEST(FreeSpace, NeverJumpsAThinStroke) {
  const Sketch sketch = testing::house();
  const FreeSpace space = space_of(sketch, {.radius_m = 0.01, .sigmas = 0.0});
  EXPECT_FALSE(space.is_free(Vector2d(10.0, 10.0), Vector2d(110.0, 10.0)));
  EXPECT_TRUE(space.is_free(Vector2d(10.0, 40.0), Vector2d(110.0, 40.0)));
}

/// The oracle looks at every twentieth of a px.
bool is_free_step_by_step(const FreeSpace& space, const Vector2d& from, const Vector2d& to) {
  const int steps = static_cast<int>(20.0 * (to - from).norm()) + 1;
  for (int i = 0; i <= steps; ++i) {
    if (!space.is_free(Vector2d(from + (to - from) * (static_cast<double>(i) / steps)))) {
      return false;
    }
  }
  return true;
}

TEST(FreeSpace, SaysOfSegmentsWhatTheirPointsSay) {
  const Sketch sketch = testing::sketch_of(testing::thin_strokes(150, 150, 12, 3));
  const FreeSpace space = space_of(sketch, {.radius_m = 0.2, .sigmas = 0.0});
  Rng rng = make_rng(5);
  int free = 0;
  int differ = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector2d from(uniform(0.0, 150.0, rng), uniform(0.0, 150.0, rng));
    const Vector2d to = from + Vector2d(gaussian(15.0, rng), gaussian(15.0, rng));
    const bool is_free = space.is_free(from, to);
    const bool expected = is_free_step_by_step(space, from, to);
    free += is_free ? 1 : 0;
    EXPECT_TRUE(expected || !is_free) << from.transpose() << " to " << to.transpose();
    differ += is_free != expected ? 1 : 0;  // the oracle misses cut corners
  }
  EXPECT_GT(free, 300);
  EXPECT_LT(differ, 40);
}

TEST(FreeSpace, MeasuresLengthsByTheLocalScale) {
  const std::vector<ScaleSample> samples = {{{20.0, 40.0}, 10.0}, {{100.0, 40.0}, 20.0}};
  const ScaleField scale(120, 80, samples, {.reach_px = 10.0, .mean_weight = 1e-6});
  const FreeSpace space(testing::house(), scale, kExact, Objective::Shortest);
  EXPECT_NEAR(space.length_m({15.0, 40.0}, {25.0, 40.0}), 1.0, 0.01);
  EXPECT_NEAR(space.length_m({95.0, 40.0}, {105.0, 40.0}), 0.5, 0.01);
  EXPECT_NEAR(space_of(testing::house()).length_m({10.0, 10.0}, {40.0, 50.0}), 5.0, 1e-6);
}

TEST(FreeSpace, MeasuresSegmentsThatLeaveAnEdgeByLessThanRounding) {
  const FreeSpace space = space_of(testing::house());
  for (const double off : {-1e-9, -1e-12, 0.0, 1e-12, 1e-9}) {
    const Vector2d from(20.0, 50.0);
    const Vector2d to(20.0 + off, 10.0);
    EXPECT_NEAR(space.length_m(from, to), 4.0, 1e-6) << off;
    EXPECT_NEAR(space.length_m(to, from), 4.0, 1e-6) << off;
    EXPECT_EQ(space.is_free(from, to), space.is_free(to, from)) << off;
  }
}

TEST(FreeSpace, PricesNearnessByTheObjective) {
  const Vector2d from(54.0, 10.0);
  const Vector2d to(54.0, 25.0);
  const Sketch sketch = testing::house();
  const double shortest = space_of(sketch).cost_m(from, to);
  const double balanced = space_of(sketch, kExact, Objective::Balanced).cost_m(from, to);
  const double safest = space_of(sketch, kExact, Objective::Safest).cost_m(from, to);
  EXPECT_NEAR(shortest, 1.5, 1e-6);
  EXPECT_GT(balanced, 1.1 * shortest);
  EXPECT_GT(safest, 2.0 * balanced);
}

TEST(FreeSpace, FindsTheNearestFreePlace) {
  const FreeSpace space = space_of(testing::house());
  const Vector2d inside(30.0, 30.0);
  EXPECT_EQ(space.nearest_free(inside), inside);
  const std::optional<Vector2d> near = space.nearest_free({57.5, 15.5});
  ASSERT_TRUE(near);
  EXPECT_TRUE(space.is_free(*near));
  EXPECT_NEAR((*near - Vector2d(57.5, 15.5)).norm(), 3.0, 1.0);
  const Sketch full = testing::sketch_of(Grid<std::uint8_t>(5, 5, 1));
  EXPECT_FALSE(space_of(full).nearest_free({2.0, 2.0}));
}

TEST(FreeSpace, CrossesStrokesAtTheirPriceOnlyWhereAsked) {
  const FreeSpace closed = space_of(testing::house(30));
  const FreeSpace open = closed.with_crossings(7.0);
  const Vector2d from(50.5, 40.5);
  const Vector2d to(70.5, 40.5);
  EXPECT_FALSE(closed.is_free(from, to));
  EXPECT_TRUE(open.is_free(from, to));
  EXPECT_NEAR(open.cost_m(from, to), 2.0 + 7.0, 1.0);
  EXPECT_TRUE(open.is_crossing({60.5, 40.5}));
  EXPECT_FALSE(open.is_crossing({30.5, 40.5}));
}

TEST(FreeSpace, RefusesBodiesOutOfRange) {
  EXPECT_THROW(validate(BodyParams{.radius_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(BodyParams{.pose_sigma_m = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

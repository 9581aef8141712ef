#include "smoothing/keyframes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/similarity_registration.hpp"

namespace sketchloc {
namespace {

/// Steps 0.2 m apart along x, each with one return.
std::vector<RunStep> straight_steps(int count) {
  std::vector<RunStep> steps;
  for (int i = 0; i < count; ++i) {
    steps.push_back({.scan = {.time_s = 0.1 * i,
                              .angle_step_rad = 0.1,
                              .max_range_m = 10.0,
                              .robot_from_laser = {},
                              .ranges_m = {2.0F}},
                     .odom_from_robot = Se2::from_xy_yaw(0.2 * i, 0.0, 0.0)});
  }
  return steps;
}

TEST(SubmapAround, PutsTheScanFirstAndThenGoesOutwardsInTime) {
  const std::vector<RunStep> steps = straight_steps(41);
  const RecentScansParams params{.max_scans = 3, .spacing_m = 0.55};
  const auto places = [&](Around which) {
    std::vector<double> x_m;
    for (const PlacedScan& placed : submap_around(steps, 20, which, params)) {
      x_m.push_back(placed.robot_from_then.x_m());
    }
    return x_m;
  };
  using ::testing::DoubleNear;
  using ::testing::ElementsAre;
  const auto near = [](double x_m) { return DoubleNear(x_m, 1e-9); };
  EXPECT_THAT(places(Around::Before), ElementsAre(near(0.0), near(-0.6), near(-1.2)));
  EXPECT_THAT(places(Around::After), ElementsAre(near(0.0), near(0.6), near(1.2)));
  EXPECT_THAT(places(Around::Both),
              ElementsAre(near(0.0), near(-0.6), near(0.6), near(-1.2), near(1.2)));
}

TEST(SubmapAround, EndsWithTheRunAndIsEmptyWhereTheScanSawNothing) {
  std::vector<RunStep> steps = straight_steps(10);
  EXPECT_EQ(submap_around(steps, 0, Around::Before, {}).size(), 1U);
  steps[4].scan.ranges_m = {20.0F};
  EXPECT_TRUE(submap_around(steps, 4, Around::Both, {}).empty());
}

/// Finds every second prior as it is.
class EverySecond : public WarpPredictor {
 public:
  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan>,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override {
    std::vector<std::optional<Registration>> found(priors.size());
    for (std::size_t i = 0; i < priors.size(); i += 2) {
      found[i] = testing::similarity_registration(priors[i], 0.1);
      found[i]->inlier_probability = 0.7;
    }
    return found;
  }
};

TEST(RegisterAt, KeepsWhatWasFound) {
  const std::vector<RunStep> steps = straight_steps(3);
  const SketchCropper drawing(Grid<std::uint8_t>(20, 20));
  const std::vector<Sim2> priors(3, Sim2::from_xy_yaw_scale(5.0, 5.0, 0.0, 2.0));
  EverySecond predictor;
  const auto submap = submap_around(steps, 1, Around::Both, {});
  const std::vector<PoseHypothesis> found = register_at(submap, drawing, predictor, priors);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].inlier_probability, 0.7);
  EXPECT_TRUE(register_at({}, drawing, predictor, priors).empty());
  EXPECT_TRUE(register_at(submap, drawing, predictor, {}).empty());
}

TEST(KeyframeParams, RefusesAWayOfNone) {
  EXPECT_THROW(validate(KeyframeParams{.way_m = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

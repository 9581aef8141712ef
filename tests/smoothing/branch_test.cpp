#include "smoothing/branch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace sketchloc {
namespace {

using ::testing::Each;
using ::testing::Optional;

PoseHypothesis at(double x_px, double y_px, double probability) {
  return {.sketch_from_robot = Sim2::from_xy_yaw_scale(x_px, y_px, 0.0, 10.0),
          .covariance = Eigen::Vector4d(0.01, 0.01, 0.001, 0.001).asDiagonal(),
          .inlier_probability = probability};
}

/// A robot that drives half a metre, 5 px, along x from each keyframe to the next.
KeyframeRun drive(std::size_t count) {
  KeyframeRun run;
  for (std::size_t k = 0; k < count; ++k) {
    run.keyframes.push_back(
        {.step = k,
         .time_s = static_cast<double>(k),
         .odom_from_robot = Se2::from_xy_yaw(0.5 * static_cast<double>(k), 0.0, 0.0),
         .way_m = k == 0 ? 0.0 : 0.5});
  }
  return run;
}

/// Two corridors, 100 px apart: hypothesis 0 in the lower one, 1 in the upper one.
KeyframeRun two_corridors(std::size_t count, double lower, double upper) {
  KeyframeRun run = drive(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double x_px = 5.0 * static_cast<double>(k);
    run.keyframes[k].hypotheses = {at(x_px, 0.0, lower), at(x_px, 100.0, upper)};
  }
  return run;
}

TEST(Branch, ChangesThePastWhereTheFutureSaysSo) {
  KeyframeRun run = two_corridors(40, 0.3, 0.9);
  for (std::size_t k = 0; k < 15; ++k) {  // at first the wrong corridor looks better
    run.keyframes[k].hypotheses[0].inlier_probability = 0.8;
    run.keyframes[k].hypotheses[1].inlier_probability = 0.6;
  }
  const Branch branch = find_branch(run, {});
  EXPECT_THAT(branch.chosen, Each(Optional(std::size_t{1})));
  EXPECT_GT(branch.probability[5][1], branch.probability[5][0]);
}

TEST(Branch, BelievesAPairOfKeyframesThatAreOnePlace) {
  // The robot comes back to where it was: then the lower corridor was likelier, now the upper one.
  KeyframeRun run = two_corridors(12, 0.95, 0.3);
  const KeyframeRun back = two_corridors(12, 0.3, 0.9);
  for (std::size_t k = 0; k < 12; ++k) {
    run.keyframes.push_back(back.keyframes[k]);
    run.keyframes.back().step += 12;
    run.pairs.push_back({.earlier = k, .later = 12 + k, .probability = 0.9});
  }
  const SmoothingParams alone{.pair_rounds = 0};
  EXPECT_THAT(find_branch(run, alone).chosen[20], Optional(std::size_t{1}));
  const Branch together = find_branch(run, {});
  EXPECT_THAT(together.chosen, Each(Optional(std::size_t{0})));
  EXPECT_GT(together.probability[20][0], find_branch(run, alone).probability[20][0]);
}

TEST(Branch, JumpsWhereTheEvidenceOutweighsIt) {
  KeyframeRun run = two_corridors(80, 0.05, 0.9);
  for (std::size_t k = 0; k < 40; ++k) {
    run.keyframes[k].hypotheses[0].inlier_probability = 0.9;
    run.keyframes[k].hypotheses[1].inlier_probability = 0.05;
  }
  const Branch branch = find_branch(run, {});
  EXPECT_THAT(branch.chosen[10], Optional(std::size_t{0}));
  EXPECT_THAT(branch.chosen[70], Optional(std::size_t{1}));
}

TEST(Branch, FollowsTheStartThatWasGiven) {
  KeyframeRun run = two_corridors(5, 0.6, 0.6);
  for (const double y_px : {0.0, 100.0}) {
    run.start_sketch_from_robot = Sim2::from_xy_yaw_scale(1.0, y_px, 0.0, 10.0);
    EXPECT_THAT(find_branch(run, {}).chosen, Each(Optional(static_cast<std::size_t>(y_px > 0.0))));
  }
}

TEST(Branch, IsTheBestOfAllPathsThatThereAre) {
  // Three keyframes of two hypotheses are eight paths: the score of each by the model's definition.
  KeyframeRun run = drive(3);
  run.keyframes[0].hypotheses = {at(0.0, 0.0, 0.5), at(3.0, 2.0, 0.7)};
  run.keyframes[1].hypotheses = {at(5.0, 1.0, 0.4), at(9.0, 3.0, 0.6)};
  run.keyframes[2].hypotheses = {at(11.0, 0.0, 0.3), at(14.0, 4.0, 0.45)};
  const SmoothingParams params;
  const auto evidence = [&](std::size_t k, std::size_t i) {
    const double p = run.keyframes[k].hypotheses[i].inlier_probability;
    return params.independent_share * std::log(p / (1.0 - p));
  };
  const auto follows = [&](std::size_t k, std::size_t i, std::size_t j) {
    const PoseHypothesis& before = run.keyframes[k - 1].hypotheses[i];
    const PoseHypothesis& now = run.keyframes[k].hypotheses[j];
    const Eigen::Matrix4d covariance =
        before.covariance + now.covariance + walk_covariance(params.walk, 0.5, 0.0);
    const double x_m = (now.sketch_from_robot.x() - before.sketch_from_robot.x()) / 10.0 - 0.5;
    const double y_m = (now.sketch_from_robot.y() - before.sketch_from_robot.y()) / 10.0;
    const double fit = -0.5 * (x_m * x_m / covariance(0, 0) + y_m * y_m / covariance(1, 1));
    return std::log(std::exp(fit) + std::exp(params.jump_log_odds));
  };
  double best = -1e9;
  std::size_t best_path = 0;
  for (std::size_t path = 0; path < 8; ++path) {
    const std::size_t i = path & 1U;
    const std::size_t j = (path >> 1U) & 1U;
    const std::size_t k = path >> 2U;
    const double score =
        evidence(0, i) + evidence(1, j) + evidence(2, k) + follows(1, i, j) + follows(2, j, k);
    best_path = score > best ? path : best_path;
    best = std::max(best, score);
  }
  const Branch branch = find_branch(run, params);
  EXPECT_EQ(*branch.chosen[0] + 2 * *branch.chosen[1] + 4 * *branch.chosen[2], best_path);
}

TEST(Branch, StatesProbabilitiesThatLeaveRoomForBeingElsewhere) {
  for (const double upper : {0.02, 0.5, 0.95}) {
    const Branch branch = find_branch(two_corridors(30, 0.02, upper), {});
    for (const std::vector<double>& probability : branch.probability) {
      EXPECT_THAT(probability, Each(::testing::Ge(0.0)));
      EXPECT_LE(std::accumulate(probability.begin(), probability.end(), 0.0), 1.0 + 1e-12);
    }
    const std::vector<double>& last = branch.probability.back();
    if (upper < 0.1) {
      EXPECT_LT(last[0] + last[1], 0.2);  // no registration believes in itself
    } else if (upper > 0.9) {
      EXPECT_GT(last[1], 0.9);
    }
  }
}

TEST(Branch, GoesOnOverKeyframesWithoutHypotheses) {
  KeyframeRun run = two_corridors(9, 0.2, 0.9);
  for (const std::size_t k : {0, 4, 5, 8}) {
    run.keyframes[k].hypotheses.clear();
  }
  const Branch branch = find_branch(run, {});
  EXPECT_FALSE(branch.chosen[0] || branch.chosen[4] || branch.chosen[8]);
  EXPECT_THAT(branch.chosen[3], Optional(std::size_t{1}));
  EXPECT_THAT(branch.chosen[6], Optional(std::size_t{1}));
  EXPECT_TRUE(find_branch(drive(3), {}).probability[1].empty());
  EXPECT_TRUE(find_branch({}, {}).chosen.empty());
}

}  // namespace
}  // namespace sketchloc

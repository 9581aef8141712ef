#include "smoothing/smooth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "motion/random.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

/// A Gaussian in one dimension.
struct Normal {
  double mean = 0.0;
  double variance = 0.0;
};

/// The exact answer: Kalman filter forward, Rauch, Tung and Striebel backward. [Rauch65]
std::vector<Normal> rts(std::span<const double> seen, std::span<const double> moved,
                        double motion_variance, double seen_variance) {
  std::vector<Normal> filtered = {{.mean = seen[0], .variance = seen_variance}};
  for (std::size_t k = 1; k < seen.size(); ++k) {
    const Normal predicted{.mean = filtered.back().mean + moved[k],
                           .variance = filtered.back().variance + motion_variance};
    const double gain = predicted.variance / (predicted.variance + seen_variance);
    filtered.push_back({.mean = predicted.mean + gain * (seen[k] - predicted.mean),
                        .variance = (1.0 - gain) * predicted.variance});
  }
  std::vector<Normal> smoothed = filtered;
  for (std::size_t k = seen.size() - 1; k-- > 0;) {
    const double gain = filtered[k].variance / (filtered[k].variance + motion_variance);
    smoothed[k].mean += gain * (smoothed[k + 1].mean - filtered[k].mean - moved[k + 1]);
    smoothed[k].variance +=
        gain * gain * (smoothed[k + 1].variance - filtered[k].variance - motion_variance);
  }
  return smoothed;
}

/// Headings and scales are known, so that the model is linear in x; registrations count in full.
SmoothingParams linear_params() {
  SmoothingParams params;
  params.walk = {.length_m = 0.2, .shear_m = 0.2, .heading_rad = 1e-5, .log_scale = 1e-5};
  params.independent_share = 1.0;
  params.min_position_m = params.min_heading_rad = params.min_log_scale = 1e-6;
  params.kernel.shape = KernelShape::None;
  return params;
}

PoseHypothesis hypothesis(double x_m, double variance, double probability = 1.0) {
  return {.sketch_from_robot = Sim2::from_xy_yaw_scale(x_m, 0.0, 0.0, 1.0),
          .covariance = Eigen::Vector4d(variance, variance, 1e-8, 1e-8).asDiagonal(),
          .inlier_probability = probability};
}

Keyframe keyframe(std::size_t step, double odom_x_m, double way_m) {
  return {.step = step,
          .time_s = static_cast<double>(step),
          .odom_from_robot = Se2::from_xy_yaw(odom_x_m, 0.0, 0.0),
          .way_m = way_m};
}

TEST(SmoothStatistical, IsTheExactAnswerOfALinearGaussianCase) {
  constexpr double kSeenVariance = 0.09;
  const SmoothingParams params = linear_params();
  const double motion_variance = walk_covariance(params.walk, 1.0, 0.0)(0, 0);
  Rng rng = make_rng(7);
  KeyframeRun run;
  std::vector<double> seen;
  std::vector<double> moved;
  std::vector<double> truth;
  double odom_m = 0.0;
  for (std::size_t k = 0; k < 400; ++k) {
    moved.push_back(k == 0 ? 0.0 : 1.0);
    odom_m += moved.back();
    truth.push_back(k == 0 ? 0.0 : truth.back() + 1.0 + gaussian(std::sqrt(motion_variance), rng));
    seen.push_back(truth.back() + gaussian(std::sqrt(kSeenVariance), rng));
    run.keyframes.push_back(keyframe(k, odom_m, moved.back()));
    run.keyframes.back().hypotheses = {hypothesis(seen.back(), kSeenVariance)};
  }
  const SmoothedRun smoothed = smooth(run, params);
  ASSERT_EQ(smoothed.status, SmoothedRun::Status::Done);
  const std::vector<Normal> exact = rts(seen, moved, motion_variance, kSeenVariance);
  double nees = 0.0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const SmoothedPose& pose = smoothed.poses[k];
    EXPECT_NEAR(pose.sketch_from_robot.x(), exact[k].mean, 1e-5) << k;
    EXPECT_NEAR(pose.covariance(0, 0), exact[k].variance, 1e-5) << k;
    const double error = pose.sketch_from_robot.x() - truth[k];
    nees += error * error / pose.covariance(0, 0) / static_cast<double>(seen.size());
  }
  // Errors of neighbours are correlated over about three keyframes, so a third of them count.
  const double standard_error = std::sqrt(2.0 / (static_cast<double>(seen.size()) / 3.0));
  EXPECT_NEAR(nees, 1.0, 5.0 * standard_error);
}

TEST(Smooth, LeavesOutRegistrationsThatAreFarFromTheBranch) {
  KeyframeRun run;
  for (std::size_t k = 0; k < 20; ++k) {
    const double x_m = 0.5 * static_cast<double>(k);
    run.keyframes.push_back(keyframe(k, x_m, k == 0 ? 0.0 : 0.5));
    run.keyframes.back().hypotheses = {hypothesis(x_m, 0.01, 0.8)};
    if (k % 3 == 0) {
      run.keyframes.back().hypotheses.push_back(hypothesis(x_m + 30.0, 0.01, 0.9));
    }
  }
  const SmoothedRun smoothed = smooth(run);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_NEAR(smoothed.poses[k].sketch_from_robot.x(), 0.5 * static_cast<double>(k), 0.02);
    EXPECT_GT(smoothed.poses[k].covariance(0, 0), 0.0);
  }
}

TEST(Smooth, CarriesKeyframesWithoutHypothesesByOdometry) {
  KeyframeRun run;
  for (std::size_t k = 0; k < 7; ++k) {
    run.keyframes.push_back(keyframe(2 * k, static_cast<double>(k), k == 0 ? 0.0 : 1.0));
  }
  run.keyframes[3].hypotheses = {hypothesis(10.0, 0.01, 0.9)};
  const SmoothedRun smoothed = smooth(run);
  ASSERT_EQ(smoothed.status, SmoothedRun::Status::Done);
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_THAT(smoothed.poses[k].sketch_from_robot,
                IsNear(Sim2::from_xy_yaw_scale(7.0 + static_cast<double>(k), 0.0, 0.0, 1.0), 1e-6));
    EXPECT_EQ(smoothed.poses[k].probability, smoothed.poses[3].probability);
  }
  EXPECT_GT(smoothed.poses[0].covariance(0, 0), smoothed.poses[3].covariance(0, 0));
}

TEST(Smooth, SaysWhereNothingTellsTheWay) {
  EXPECT_EQ(smooth({}).status, SmoothedRun::Status::NoEvidence);
  EXPECT_EQ(smooth({.keyframes = {keyframe(0, 0.0, 0.0)}}).status, SmoothedRun::Status::NoEvidence);
}

TEST(Smooth, KeepsTheOneKeyframeThatThereIs) {
  KeyframeRun run{.keyframes = {keyframe(0, 0.0, 0.0)}};
  run.keyframes[0].hypotheses = {hypothesis(4.0, 0.01, 0.9)};
  EXPECT_NEAR(smooth(run).poses.at(0).sketch_from_robot.x(), 4.0, 1e-9);
}

TEST(Smooth, RefusesParametersOutOfRange) {
  EXPECT_THROW(smooth({}, {.jump_log_odds = 1.0}), std::invalid_argument);
  EXPECT_THROW(smooth({}, {.kernel = {.shape = KernelShape::Graduated}}), std::invalid_argument);
}

TEST(CarriedPoses, GoOverFromOneKeyframeToTheNext) {
  KeyframeRun run;
  run.keyframes = {keyframe(1, 1.0, 0.0), keyframe(3, 3.0, 2.0)};
  // The drawing shows the second keyframe 1 px ahead of where odometry takes the first one.
  const std::vector<SmoothedPose> smoothed = {
      {.sketch_from_robot = Sim2::from_xy_yaw_scale(10.0, 0.0, 0.0, 1.0)},
      {.sketch_from_robot = Sim2::from_xy_yaw_scale(13.0, 0.0, 0.0, 1.0)}};
  std::vector<Se2> odom;
  for (int step = 0; step < 5; ++step) {
    odom.push_back(Se2::from_xy_yaw(step, 0.0, 0.0));
  }
  const std::vector<Sim2> poses = carried_poses(run, smoothed, odom);
  const double expected_px[] = {9.0, 10.0, 11.5, 13.0, 14.0};
  ASSERT_EQ(poses.size(), 5U);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].x(), expected_px[i], 1e-12) << i;
  }
}

}  // namespace
}  // namespace sketchloc

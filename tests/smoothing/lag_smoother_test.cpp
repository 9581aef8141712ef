#include "smoothing/lag_smoother.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "motion/random.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/similarity_registration.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

/// Of a robot that drives along x, metre by metre in steps, in a drawing of one pixel per metre.
RunStep step_at(double x_m, double time_s) {
  return {.scan = {.time_s = time_s,
                   .angle_step_rad = 0.1,
                   .max_range_m = 10.0,
                   .robot_from_laser = {},
                   .ranges_m = {2.0F}},
          .odom_from_robot = Se2::from_xy_yaw(x_m, 0.0, 0.0)};
}

PoseHypothesis belief(double x_m, double y_m, double probability) {
  return {.sketch_from_robot = Sim2::from_xy_yaw_scale(x_m, y_m, 0.0, 1.0),
          .covariance = 0.04 * Eigen::Matrix4d::Identity(),
          .inlier_probability = probability};
}

/// Looks at a scan once, and measures x.
class MeasuresOnce : public WarpPredictor {
 public:
  MeasuresOnce(std::vector<double> seen_m, double variance)
      : seen_m_(std::move(seen_m)), variance_(variance) {}

  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override {
    std::vector<std::optional<Registration>> found(priors.size());
    const auto k = static_cast<std::size_t>(std::lround(submap.front().scan->time_s));
    if (looked_at_.insert(k).second) {
      found[0] =
          testing::similarity_registration(Sim2::from_xy_yaw_scale(seen_m_[k], 0.0, 0.0, 1.0), 1.0);
      found[0]->covariance = Eigen::Vector4d(variance_, variance_, 1e-8, 1e-8).asDiagonal();
      found[0]->inlier_probability = 1.0;
    }
    return found;
  }

 private:
  std::vector<double> seen_m_;
  double variance_;
  std::set<std::size_t> looked_at_;
};

/// Mean of x at instant k of a random walk that is measured at instants 0 to `last`, exactly: the
/// least squares of all of them as one dense system.
double exact_mean(std::span<const double> seen_m, std::size_t k, std::size_t last,
                  double walk_variance, double seen_variance) {
  const auto count = static_cast<Eigen::Index>(last + 1);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    information(i, i) += 1.0 / seen_variance;
    right[i] += seen_m[static_cast<std::size_t>(i)] / seen_variance;
    if (i > 0) {  // x_i - x_{i-1} = 1
      information.block(i - 1, i - 1, 2, 2) +=
          (Eigen::Matrix2d() << 1.0, -1.0, -1.0, 1.0).finished() / walk_variance;
      right[i] += 1.0 / walk_variance;
      right[i - 1] -= 1.0 / walk_variance;
    }
  }
  return Eigen::VectorXd(information.ldlt().solve(right))[static_cast<Eigen::Index>(k)];
}

std::vector<LaggedPose> take_all(LagSmoother& smoother) {
  while (smoother.work()) {
  }
  return smoother.take();
}

const SketchCropper& nowhere() {
  static const SketchCropper drawing{Grid<std::uint8_t>(20, 20)};
  return drawing;
}

/// A filter that goes back by odometry alone.
LagSmootherParts parts(WarpPredictor& predictor) {
  return {.drawing = nowhere(),
          .predictor = predictor,
          .step_back = [y = 0.0](const RunStep& step, const std::optional<Sim2>& start) mutable {
            y = start ? start->y() : y;
            return std::vector{Sim2::from_xy_yaw_scale(step.odom_from_robot.x_m(), y, 0.0, 1.0)};
          }};
}

/// A linear case: headings and scales are known, registrations count in full, the filter's own
/// belief does not.
LagSmootherParams linear_params() {
  LagSmootherParams params;
  params.lag.lag_m = 4.0;
  params.lag.memory_m = 1000.0;
  params.keyframes = {.way_m = 0.9, .turn_rad = 0.8, .submap = {.max_scans = 1}};
  SmoothingParams& smoothing = params.smoothing;
  smoothing.walk = {.length_m = 0.2, .shear_m = 0.2, .heading_rad = 1e-5, .log_scale = 1e-5};
  smoothing.independent_share = 1.0;
  smoothing.min_position_m = smoothing.min_heading_rad = smoothing.min_log_scale = 1e-6;
  smoothing.kernel.shape = KernelShape::None;
  return params;
}

TEST(LagSmootherStatistical, IsTheExactAnswerOfAllThatWasSeenUpToTheLag) {
  constexpr double kSeenVariance = 0.09;
  constexpr std::size_t kLag = 4;
  const LagSmootherParams params = linear_params();
  const double walk_variance = walk_covariance(params.smoothing.walk, 1.0, 0.0)(0, 0);
  Rng rng = make_rng(11);
  std::vector<double> seen_m;
  double truth_m = 0.0;
  for (std::size_t k = 0; k < 30; ++k) {
    truth_m += k == 0 ? 0.0 : 1.0 + gaussian(std::sqrt(walk_variance), rng);
    seen_m.push_back(truth_m + gaussian(std::sqrt(kSeenVariance), rng));
  }
  MeasuresOnce predictor(seen_m, kSeenVariance);
  LagSmoother smoother(parts(predictor), params, std::nullopt);
  for (std::size_t k = 0; k < seen_m.size(); ++k) {
    const auto x_m = static_cast<double>(k);
    smoother.add(step_at(x_m, x_m), std::vector{belief(seen_m[k], 0.0, 0.0)});
    const std::vector<LaggedPose> found = take_all(smoother);
    ASSERT_EQ(found.size(), k < kLag ? 0U : 1U) << k;
    if (k >= kLag) {
      EXPECT_EQ(found[0].step, k - kLag);
      EXPECT_NEAR(found[0].way_m, 4.0, 1e-9);
      EXPECT_NEAR(found[0].pose.sketch_from_robot.x(),
                  exact_mean(seen_m, k - kLag, k, walk_variance, kSeenVariance), 1e-4);
    }
  }
}

/// Finds the truth (y = 0) from within a metre of it, else stays where it is and doubts it.
class FindsTruth : public WarpPredictor {
 public:
  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan>,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override {
    std::vector<std::optional<Registration>> found;
    for (const Sim2& prior : priors) {
      const bool is_near = std::abs(prior.y()) < 1.0;
      const Sim2 pose = is_near ? Sim2::from_xy_yaw_scale(prior.x(), 0.0, 0.0, 1.0) : prior;
      found.emplace_back(testing::similarity_registration(pose, 0.1));
      found.back()->inlier_probability = is_near ? 0.9 : 0.4;
    }
    return found;
  }
};

/// A filter that is 5 m beside the truth until 12 m, and right from then on.
template <typename Told>
void tell_of_filter_that_comes_back(LagSmoother& smoother, const Told& told) {
  for (int i = 0; i < 150; ++i) {
    const double x_m = 0.2 * i;
    const bool is_right = x_m >= 12.0;
    smoother.add(step_at(x_m, 0.1 * i),
                 std::vector{belief(x_m, is_right ? 0.0 : 5.0, is_right ? 0.9 : 0.5)});
    while (smoother.work()) {
    }
    told();
  }
}

std::vector<LaggedPose> lagged_where_the_filter_comes_back(double lag_m) {
  FindsTruth predictor;
  LagSmootherParams params;
  params.lag.lag_m = lag_m;
  LagSmoother smoother(parts(predictor), params, std::nullopt);
  std::vector<LaggedPose> all;
  const auto take = [&] {
    for (const LaggedPose& pose : smoother.take()) {
      all.push_back(pose);
    }
  };
  tell_of_filter_that_comes_back(smoother, take);
  smoother.finish();
  take();
  return all;
}

/// From where on a hypothesis is right, of a run that is smoothed as a whole.
double known_from_m(double back_m, double back_on_log_odds) {
  FindsTruth predictor;
  LagSmootherParams params;
  params.lag.back_m = back_m;
  params.lag.back_on_log_odds = back_on_log_odds;
  params.lag.lag_m = std::numeric_limits<double>::max();
  LagSmoother smoother(parts(predictor), params, std::nullopt);
  tell_of_filter_that_comes_back(smoother, [] {});
  EXPECT_TRUE(smoother.take().empty());
  for (const Keyframe& keyframe : smoother.known().keyframes) {
    for (const PoseHypothesis& one : keyframe.hypotheses) {
      if (std::abs(one.sketch_from_robot.y()) < 0.5) {
        return keyframe.odom_from_robot.x_m();
      }
    }
  }
  return std::numeric_limits<double>::infinity();
}

TEST(LagSmoother, GoesBackSoFarAndOnWhereTheFilterKnewLess) {
  // The log odds of 0.9 are 2.2, of 0.5 they are 0. The first filter that is right begins at 12 m;
  // keyframes are 0.6 m apart, and the one where it has gone more than 3 m is its last.
  EXPECT_NEAR(known_from_m(3.0, 2.3), 8.4, 1e-6);
  EXPECT_LT(known_from_m(3.0, 2.1), 1.0);
}

TEST(LagSmoother, KnowsTheWholeRunWhereTheLagIsBeyondIt) {
  FindsTruth predictor;
  LagSmootherParams params;
  params.lag.lag_m = std::numeric_limits<double>::max();
  const Sim2 start = Sim2::from_xy_yaw_scale(0.0, 0.0, 0.0, 1.0);
  LagSmoother smoother(parts(predictor), params, start);
  tell_of_filter_that_comes_back(smoother, [] {});
  const KeyframeRun known = smoother.known();
  ASSERT_EQ(known.keyframes.size(), 50U);  // 29.8 m, one each 0.6 m
  EXPECT_EQ(known.keyframes.back().step, 147U);
  EXPECT_GE(known.keyframes.back().hypotheses.size(), 2U);  // nothing comes after: it is looked at
  ASSERT_TRUE(known.start_sketch_from_robot.has_value());
  EXPECT_THAT(*known.start_sketch_from_robot, IsNear(start, 1e-12));
}

TEST(LagSmoother, GoesBackFromWhatIsKnownAtTheEndOfTheLag) {
  const std::vector<LaggedPose> lagged = lagged_where_the_filter_comes_back(10.0);
  ASSERT_EQ(lagged.size(), 150U);
  for (const LaggedPose& pose : lagged) {
    const double x_m = 0.2 * static_cast<double>(pose.step);
    if (x_m > 6.0) {  // the end of the lag is well beyond 12 m
      EXPECT_THAT(pose.pose.sketch_from_robot,
                  IsNear(Sim2::from_xy_yaw_scale(x_m, 0.0, 0.0, 1.0), 0.1))
          << x_m;
    }
  }
}

TEST(LagSmoother, GivesEachPoseOnceInOrderAndOnlyAfterTheLag) {
  const std::vector<LaggedPose> lagged = lagged_where_the_filter_comes_back(3.0);
  ASSERT_EQ(lagged.size(), 150U);
  for (std::size_t i = 0; i < lagged.size(); ++i) {
    EXPECT_EQ(lagged[i].step, i);
    const bool is_end = 0.2 * static_cast<double>(i) > 29.8 - 3.0 - 0.6;  // less than a keyframe
    EXPECT_TRUE(is_end || lagged[i].way_m >= 3.0 - 1e-9) << i;
  }
}

TEST(LagSmoother, LeavesOutWorkButNoPoseWhereItIsBehind) {
  FindsTruth predictor;
  LagSmoother smoother(parts(predictor), {}, std::nullopt);
  for (int i = 0; i < 200; ++i) {
    smoother.add(step_at(0.2 * i, 0.1 * i), std::vector{belief(0.2 * i, 0.0, 0.9)});
  }
  EXPECT_TRUE(smoother.has_work());
  smoother.finish();
  EXPECT_FALSE(smoother.has_work());
  EXPECT_EQ(smoother.take().size(), 200U);
}

TEST(LagSmoother, TakesTheFiltersPoseWhereNothingCanBeRegistered) {
  FindsTruth predictor;
  LagSmoother smoother(parts(predictor), {}, std::nullopt);
  RunStep blind = step_at(0.0, 0.0);
  blind.scan.ranges_m = {20.0F};
  smoother.add(blind, std::vector{belief(3.0, 4.0, 0.25)});
  smoother.finish();
  const std::vector<LaggedPose> found = smoother.take();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].pose.sketch_from_robot,
              IsNear(Sim2::from_xy_yaw_scale(3.0, 4.0, 0.0, 1.0), 1e-6));
}

TEST(LagParams, RefusesNoLag) {
  FindsTruth predictor;
  LagSmootherParams params;
  params.lag.lag_m = 0.0;
  EXPECT_THROW(LagSmoother(parts(predictor), params, std::nullopt), std::invalid_argument);
  params.lag = {};
  params.lag.back_m = 0.0;
  EXPECT_THROW(validate(params), std::invalid_argument);
  params.lag = {};
  params.lag.back_on_log_odds = 0.0;
  EXPECT_THROW(validate(params), std::invalid_argument);
}

TEST(HypothesisOf, TakesTheCovarianceToTheRobotFrameAndBack) {
  Eigen::Matrix4d covariance = Eigen::Vector4d(16.0, 4.0, 0.01, 0.02).asDiagonal();
  covariance(0, 2) = covariance(2, 0) = 0.1;
  const PoseHypothesis hypothesis = hypothesis_of(
      Sim2::from_xy_yaw_scale(1.0, 2.0, 0.5 * 3.14159265358979, 2.0), covariance, 0.7);
  EXPECT_NEAR(hypothesis.covariance(0, 0), 1.0, 1e-9);  // the robot looks along the sketch's y
  EXPECT_NEAR(hypothesis.covariance(1, 1), 4.0, 1e-9);
  EXPECT_NEAR(hypothesis.covariance(1, 2), -0.05, 1e-9);
  EXPECT_TRUE(covariance_in_sketch(hypothesis).isApprox(covariance, 1e-9));
}

}  // namespace
}  // namespace sketchloc

#include "smoothing/drawing_spline.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "motion/random.hpp"

namespace sketchloc {
namespace {

constexpr double kPxPerM = 20.0;

/// A drawing that is 20 px/m, sheared, and bent by `bend`: a smooth map of the world.
PlaneMapPoint bent(const Eigen::Vector2d& p, double bend) {
  const double u = p.x() / 6.0;
  const double v = p.y() / 7.0;
  PlaneMapPoint map;
  map.value = kPxPerM * Eigen::Vector2d(p.x() + 0.2 * p.y() + bend * std::sin(v),
                                        p.y() + bend * std::cos(u) + 10.0);
  map.jacobian << 1.0, 0.2 + bend * std::cos(v) / 7.0, -bend * std::sin(u) / 6.0, 1.0;
  map.jacobian *= kPxPerM;
  return map;
}

Sim2 drawn(const Se2& world_from_robot, double bend) {
  const PlaneMapPoint map = bent(world_from_robot.translation(), bend);
  const Eigen::Matrix2d& j = map.jacobian;
  return Sim2::from_xy_yaw_scale(
      map.value.x(), map.value.y(),
      std::atan2(j(1, 0) - j(0, 1), j(0, 0) + j(1, 1)) + world_from_robot.yaw_rad(),
      std::sqrt(j.determinant()));
}

struct Drive {
  std::vector<Se2> world_from_robot;
  KeyframeRun run;
  std::vector<SmoothedPose> smoothed;
};

/// Twice around a figure of 20 m x 10 m, registered at every keyframe with errors of `sigma_m`,
/// half of that in radians and logs; odometry that turns too far by `drift` rad/m.
Drive drive(double bend, double sigma_m, double drift, std::uint64_t seed = 1) {
  Rng rng = make_rng(seed);
  Drive result;
  const Eigen::Vector4d sigma(sigma_m, sigma_m, 0.5 * sigma_m, 0.5 * sigma_m);
  for (int k = 0; k < 160; ++k) {
    const double phase = 4.0 * std::numbers::pi * k / 160.0;
    const double yaw = std::atan2(10.0 * std::cos(2.0 * phase), -10.0 * std::sin(phase));
    const Se2 pose = Se2::from_xy_yaw(10.0 * std::cos(phase), 5.0 * std::sin(2.0 * phase), yaw);
    Keyframe keyframe{.step = static_cast<std::size_t>(k), .odom_from_robot = pose};
    if (k > 0) {
      const Se2 moved = result.world_from_robot.back().inverse() * pose;
      keyframe.way_m = moved.translation().norm();
      keyframe.turn_rad = std::abs(moved.yaw_rad());
      keyframe.odom_from_robot = result.run.keyframes.back().odom_from_robot * moved *
                                 Se2::from_xy_yaw(0.0, 0.0, drift * keyframe.way_m);
    }
    const Eigen::Vector4d error = sigma.cwiseProduct(Eigen::Vector4d(
        gaussian(1.0, rng), gaussian(1.0, rng), gaussian(1.0, rng), gaussian(1.0, rng)));
    const Sim2 said = drawn(pose, bend) *
                      Sim2::from_xy_yaw_scale(error.x(), error.y(), error.z(), std::exp(error.w()));
    const Eigen::Vector4d stated = sigma.cwiseMax(1e-3);
    keyframe.hypotheses = {{.sketch_from_robot = said,
                            .covariance = stated.cwiseAbs2().asDiagonal(),
                            .inlier_probability = 0.95}};
    result.world_from_robot.push_back(pose);
    result.run.keyframes.push_back(keyframe);
    result.smoothed.push_back({.sketch_from_robot = said});
  }
  return result;
}

/// RMS distance, in metres, between where the spline has points beside the way and where they are.
double map_error_m(const Drive& drive, const DrawingSpline& spline, double bend, double beside_m) {
  double sum = 0.0;
  for (std::size_t k = 0; k < drive.world_from_robot.size(); ++k) {
    for (const double side : {-beside_m, beside_m}) {
      const Eigen::Vector2d point(0.0, side);
      sum += (spline.sketch_from_metric(spline.metric_from_robot[k] * point) -
              bent(drive.world_from_robot[k] * point, bend).value)
                 .squaredNorm();
    }
  }
  return std::sqrt(sum / static_cast<double>(2 * drive.world_from_robot.size())) / kPxPerM;
}

TEST(DrawingSpline, FindsABentDrawing) {
  const Drive exact = drive(0.8, 0.0, 0.0);
  const auto spline = fit_drawing_spline(exact.run, exact.smoothed);
  ASSERT_TRUE(spline);
  EXPECT_TRUE(spline->converged);
  EXPECT_LT(map_error_m(exact, *spline, 0.8, 0.0), 0.02);
  EXPECT_LT(map_error_m(exact, *spline, 0.8, 1.0), 0.1);
  EXPECT_GT(spline->effective_parameters, 20.0);
  EXPECT_LT(spline->residual_m, 0.02);
}

TEST(DrawingSpline, KeepsAnAffineDrawingStraight) {
  const Drive straight = drive(0.0, 0.1, 0.0);
  const auto spline = fit_drawing_spline(straight.run, straight.smoothed);
  ASSERT_TRUE(spline);
  EXPECT_LT(spline->effective_parameters, 12.0);
  EXPECT_LT(map_error_m(straight, *spline, 0.0, 3.0), 0.1);
}

TEST(DrawingSpline, TakesTheDriftOutOfTheTrajectory) {
  const Drive drifting = drive(0.3, 0.05, 0.004);
  const auto spline =
      fit_drawing_spline(drifting.run, drifting.smoothed, {.slip_m = 0.02, .turn_rad = 0.01});
  ASSERT_TRUE(spline);
  const auto worst = [&](const auto& pose_of) {
    double most = 0.0;
    for (std::size_t k = 0; k < drifting.world_from_robot.size(); ++k) {
      most = std::max(
          most, (pose_of(k).translation() - drifting.world_from_robot[k].translation()).norm());
    }
    return most;
  };
  const double before =
      worst([&](std::size_t k) { return drifting.run.keyframes[k].odom_from_robot; });
  const double after = worst([&](std::size_t k) { return spline->metric_from_robot[k]; });
  EXPECT_GT(before, 1.5);
  EXPECT_LT(after, 0.4 * before);
}

/// A stretch of wrong registrations does not bend the drawing.
TEST(DrawingSpline, IsNotBentByAWrongStretch) {
  Drive wrong = drive(0.3, 0.05, 0.0);
  for (std::size_t k = 40; k < 48; ++k) {
    const Sim2 off = Sim2::from_xy_yaw_scale(2.0, 1.0, 0.1, 1.0);
    wrong.smoothed[k].sketch_from_robot = wrong.smoothed[k].sketch_from_robot * off;
    wrong.run.keyframes[k].hypotheses[0].sketch_from_robot = wrong.smoothed[k].sketch_from_robot;
  }
  const auto spline = fit_drawing_spline(wrong.run, wrong.smoothed);
  ASSERT_TRUE(spline);
  EXPECT_LT(map_error_m(wrong, *spline, 0.3, 0.0), 0.15);
}

/// The stated spread is that of the errors, over many drives.
TEST(DrawingSplineStatistical, StatesHowWellAPlaceIsKnown) {
  constexpr int kDrives = 60;
  const Eigen::Vector2d place(5.0, 3.0);
  double sum = 0.0;
  double square_sum = 0.0;
  for (int i = 0; i < kDrives; ++i) {
    const Drive noisy = drive(0.2, 0.1, 0.0, 100 + static_cast<std::uint64_t>(i));
    const auto spline = fit_drawing_spline(
        noisy.run, noisy.smoothed, {.max_controls = 40, .independent_way_m = 0.1, .freedom = 1e6});
    ASSERT_TRUE(spline);
    const double off_m =
        (spline->sketch_from_metric(place) - bent(place, 0.2).value).norm() / kPxPerM;
    const double normalised = std::pow(off_m / spline->sigma_m(place), 2);
    sum += normalised;
    square_sum += normalised * normalised;
  }
  // Of two axes, of which sigma_m is the worse: between 1 and 2 in the mean, if drawings were drawn
  // from the prior. This one bends less than they do, which makes it half as much at the least.
  const double mean = sum / kDrives;
  const double five_sigma = 5.0 * std::sqrt((square_sum / kDrives - mean * mean) / kDrives);
  EXPECT_LT(mean - five_sigma, 2.0);
  EXPECT_GT(mean + five_sigma, 0.5);
}

TEST(DrawingSpline, IsNoneOfARobotThatStands) {
  Drive still = drive(0.0, 0.1, 0.0);
  for (Keyframe& keyframe : still.run.keyframes) {
    keyframe.odom_from_robot = Se2();
  }
  EXPECT_FALSE(fit_drawing_spline(still.run, still.smoothed));
  EXPECT_FALSE(fit_drawing_spline({}, {}));
}

TEST(DrawingSplineParams, RefuseWhatIsOutOfRange) {
  EXPECT_THROW(validate(DrawingSplineParams{.spacing_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(DrawingSplineParams{.max_controls = 4}), std::invalid_argument);
  EXPECT_THROW(validate(DrawingSplineParams{.freedom = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

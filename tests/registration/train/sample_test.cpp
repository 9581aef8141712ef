#include "registration/train/sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "registration/network_output.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/similarity_registration.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

/// A home drawn as [Chen20] does.
const Scene& spline_home() {
  static const Scene scene = [] {
    Rng rng = make_rng(11);
    return Scene({.human_share = 0.0, .home_share = 1.0, .office_share = 0.0, .drive_m = 20.0},
                 rng);
  }();
  return scene;
}

PriorError no_error() { return {.max_shift_m = 0.0, .max_turn_rad = 0.0, .log_scale_sigma = 0.0}; }

TEST(Sample, PriorsWithoutErrorAreTrue) {
  Rng rng = make_rng(1);
  const Sim2 truth = Sim2::from_xy_yaw_scale(100.0, 50.0, 0.4, 17.0);
  EXPECT_THAT(draw_prior(truth, no_error(), rng), IsNear(truth, 1e-12));
}

TEST(Sample, PriorsStayWithinTheirError) {
  Rng rng = make_rng(2);
  const PriorError error;
  const Sim2 truth = Sim2::from_xy_yaw_scale(100.0, 50.0, 0.4, 17.0);
  double farthest_m = 0.0;
  int small = 0;
  for (int i = 0; i < 2000; ++i) {
    const Sim2 truth_from_prior = truth.inverse() * draw_prior(truth, error, rng);
    const double shift_m = truth_from_prior.translation().norm();
    EXPECT_LE(shift_m, error.max_shift_m + 1e-9);
    EXPECT_LE(std::abs(truth_from_prior.yaw_rad()), error.max_turn_rad + 1e-9);
    farthest_m = std::max(farthest_m, shift_m);
    small += shift_m < 0.3 ? 1 : 0;
  }
  EXPECT_GT(farthest_m, 2.8);
  EXPECT_GT(small, 200);
}

TEST(Sample, LabelsThePoseInTheFrameOfThePrior) {
  Rng rng = make_rng(3);
  const Sample sample = draw_sample(spline_home(), {}, InputKind::Residual, rng);
  const Sim2 prior_from_robot = Sim2::from_xy_yaw_scale(sample.pose[0], sample.pose[1],
                                                        sample.pose[2], std::exp(sample.pose[3]));
  EXPECT_THAT(sample.prior_sketch_from_robot * prior_from_robot,
              IsNear(sample.sketch_from_robot, 1e-3));
}

/// Finds every prior right.
class Contented final : public WarpPredictor {
 public:
  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan>,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override {
    return {testing::similarity_registration(priors.front())};
  }
};

TEST(Sample, LooksAgainThroughAFinerWindow) {
  Contented contented;
  SampleParams params;
  params.prior.improved_share = 1.0;
  const ImprovingNetworks networks{.once = &contented, .twice = &contented};
  double least_m = params.side_m;
  double most_m = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Rng rng = make_rng(seed, 7);
    const Sample sample = draw_sample(spline_home(), params, InputKind::Residual, rng, networks);
    least_m = std::min(least_m, sample.window.side_m);
    most_m = std::max(most_m, sample.window.side_m);
    const double unit = unit_m(sample.window);
    const Sim2 prior_from_robot = Sim2::from_xy_yaw_scale(
        unit * sample.pose[0], unit * sample.pose[1], sample.pose[2], std::exp(sample.pose[3]));
    EXPECT_THAT(sample.prior_sketch_from_robot * prior_from_robot,
                IsNear(sample.sketch_from_robot, 1e-3));
  }
  EXPECT_GE(least_m, params.min_fine_side_m);
  EXPECT_LT(least_m, params.min_fine_side_m + 1.0);
  EXPECT_LE(most_m, params.max_fine_side_m);
  EXPECT_GT(most_m, params.max_fine_side_m - 1.0);
}

/// Finds every prior right, the last one by far the surest.
class SureOfTheLast final : public WarpPredictor {
 public:
  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan>,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override {
    std::vector<std::optional<Registration>> found;
    for (const Sim2& prior : priors) {
      found.emplace_back(testing::similarity_registration(prior));
      found.back()->inlier_probability = 0.1;
    }
    found.back()->inlier_probability = 0.9;
    asked_ = std::max(asked_, priors.size());
    last_ = priors.back();
    return found;
  }

  std::size_t asked_ = 0;
  Sim2 last_;
};

TEST(Sample, OfSomethingRegisteredIsWhereItWasFound) {
  SureOfTheLast network;
  const ImprovingNetworks networks{.once = &network, .twice = &network};
  SampleParams params{.prior = no_error()};
  int near = 0;
  for (const double elsewhere_share : {0.0, 1.0}) {
    params.registered.elsewhere_share = elsewhere_share;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      Rng rng = make_rng(seed, 8);
      const Sample sample = draw_registered(spline_home(), params, rng, networks);
      EXPECT_THAT(sample.prior_sketch_from_robot, IsNear(network.last_, 1e-12));
      const double off_m = (sample.sketch_from_robot.inverse() * sample.prior_sketch_from_robot)
                               .translation()
                               .norm();
      const double unit = unit_m(sample.window);
      const Sim2 told = Sim2::from_xy_yaw_scale(unit * sample.pose[0], unit * sample.pose[1],
                                                sample.pose[2], std::exp(sample.pose[3]));
      EXPECT_THAT(sample.prior_sketch_from_robot * told, IsNear(sample.sketch_from_robot, 1e-3));
      EXPECT_EQ(sample.input.size(), 5U * 64U * 64U);
      if (elsewhere_share == 0.0) {
        EXPECT_LT(off_m, 1e-9);
      } else {
        near += off_m < 2.0 ? 1 : 0;
      }
    }
  }
  EXPECT_LT(near, 20);  // of 30 in a home
  EXPECT_EQ(network.asked_, static_cast<std::size_t>(params.registered.elsewhere_priors));
}

TEST(Sample, GridLabelsAndControlLabelsAreOfOneWarp) {
  Rng rng = make_rng(4);
  const SampleParams params{.prior = no_error()};
  const Sample sample = draw_sample(spline_home(), params, InputKind::Residual, rng);
  const Eigen::MatrixXd matrix = spline_matrix(control_points_in_robot(params.window()),
                                               grid_points_in_robot(params.window()));
  double sum_m = 0.0;
  double shift_m = 0.0;
  int indoors = 0;
  for (int i = 0; i < kGridPoints; ++i) {
    const auto point = static_cast<std::size_t>(i);
    if (sample.grid_weight[point] == 0.0F) {
      continue;
    }
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();
    for (int j = 0; j < kControls; ++j) {
      const auto control = static_cast<std::size_t>(j);
      shift += matrix(i, j) * Eigen::Vector2d(sample.control_shift[2 * control],
                                              sample.control_shift[2 * control + 1]);
    }
    sum_m +=
        (shift - Eigen::Vector2d(sample.grid_shift[2 * point], sample.grid_shift[2 * point + 1]))
            .norm();
    shift_m += std::hypot(sample.grid_shift[2 * point], sample.grid_shift[2 * point + 1]);
    ++indoors;
  }
  ASSERT_GT(indoors, 50);
  EXPECT_LT(sum_m, 0.5 * shift_m);  // sixteen points 5 m apart tell most of the bending
}

TEST(Sample, ScanLiesOnTheStrokesWhereThePriorIsTrue) {
  // End points that are not of furniture meet strokes; through a wrong prior fewer do.
  const SampleParams right{.alone_share = 0.0, .prior = no_error()};
  SampleParams wrong = right;
  wrong.prior = {
      .max_shift_m = 3.0, .max_turn_rad = 0.7, .log_scale_sigma = 0.2, .full_share = 1.0};
  const auto agreement = [](const SampleParams& params) {
    double on_strokes = 0.0;
    double all = 0.0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Rng rng = make_rng(seed, 5);
      const Sample sample = draw_sample(spline_home(), params, InputKind::Residual, rng);
      const std::size_t plane = sample.input.size() / 5;
      for (std::size_t i = 0; i < plane; ++i) {
        on_strokes += static_cast<double>(sample.input[i] * sample.input[3 * plane + i]);
        all += static_cast<double>(sample.input[i]);
      }
    }
    return on_strokes / all;
  };
  EXPECT_GT(agreement(right), 0.7);
  EXPECT_GT(agreement(right), agreement(wrong) + 0.15);
}

TEST(Sample, PublishedLabelsAreTheWarpBackwards) {
  // With the true position as the prior, the middle of the crop comes from the middle of the scan.
  Rng rng = make_rng(6);
  const Sample sample =
      draw_sample(spline_home(), {.prior = no_error()}, InputKind::Published, rng);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i : {5U, 6U, 9U, 10U}) {
    mean +=
        0.25 * Eigen::Vector2d(sample.published_source[2 * i], sample.published_source[2 * i + 1]);
  }
  EXPECT_LT(mean.norm(), 0.2);  // of half a side; the rest is bending
  // and the first row of the grid runs along the drawing's x axis, turned against the robot's
  const Eigen::Vector2d along(sample.published_source[12] - sample.published_source[10],
                              sample.published_source[13] - sample.published_source[11]);
  EXPECT_NEAR(wrap_rad(std::atan2(along.y(), along.x()) + sample.sketch_from_robot.yaw_rad()), 0.0,
              0.3);
}

TEST(Sample, RefusesParametersOutOfRange) {
  EXPECT_NO_THROW(validate(SampleParams{}));
  EXPECT_THROW(validate(SampleParams{.max_scans = 0}), std::invalid_argument);
  EXPECT_THROW(validate(SampleParams{.min_fine_side_m = 9.0, .max_fine_side_m = 8.0}),
               std::invalid_argument);
  EXPECT_THROW(validate(PriorError{.least_size = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(RegisteredParams{.elsewhere_share = 1.5}), std::invalid_argument);
  EXPECT_THROW(validate(RegisteredParams{.elsewhere_priors = 0}), std::invalid_argument);
  EXPECT_THROW(validate(SceneParams{.home_share = 0.7, .office_share = 0.7}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

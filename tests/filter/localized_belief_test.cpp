#include "filter/localized_belief.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "motion/random.hpp"

namespace sketchloc {
namespace {

double probability(const LocalizedBelief& belief) {
  return 1.0 / (1.0 + std::exp(-belief.log_odds));
}

/// Nothing changes by itself, and a step says what its weights say.
LocalizedParams plain_params() {
  LocalizedParams params;
  params.lost_way_m = 1e12;
  params.found_way_m = 1e12;
  params.max_ratio = 10.0;
  params.beams = {.bias = 1.0, .evidence = 2.0};
  return params;
}

TEST(LocalizedBelief, AddsTheLogRatiosOfWhatItSees) {
  LocalizedBelief belief{.log_odds = 0.3};
  belief.add({.way_m = 1.0, .new_share = 0.5, .evidence = -0.25}, plain_params());
  EXPECT_NEAR(belief.log_odds, 0.3 + 0.5 * (1.0 - 2.0 * 0.25), 1e-6);
}

double density(double x, double mean, double sigma) {
  const double away = (x - mean) / sigma;
  return std::exp(-0.5 * away * away) / sigma;
}

/// What three registrations say with the quality integrated out numerically.
TEST(LocalizedBelief, WeighsRegistrationsByWhatTheDrawingIsGoodFor) {
  LocalizedParams params = plain_params();
  params.registered.quality_way_m = 1e12;
  params.registered.place = 0.5;
  const RegistrationSigns& signs = params.registered;
  const std::array<double, 3> inliers = {0.9, 0.3, 0.6};
  LocalizedBelief belief{.log_odds = 0.3};
  double wrong = 1.0;
  for (const double inlier : inliers) {
    belief.add(
        {.new_share = 1.0, .evidence = -0.25, .inlier_probability = inlier, .place_log_odds = 1.5},
        params);
    wrong *= density(std::log(inlier / (1.0 - inlier)) + 0.75, signs.wrong_mean, signs.wrong_sigma);
  }
  constexpr double kStep = 1e-3;
  double right = 0.0;
  double mean = 0.0;
  for (double z = -8.0; z <= 8.0; z += kStep) {
    double likelihood = density(z, 0.0, 1.0) / std::sqrt(2.0 * std::numbers::pi) * kStep;
    for (const double inlier : inliers) {
      likelihood *= density(std::log(inlier / (1.0 - inlier)) + 0.75,
                            signs.quality_mean + signs.quality_sigma * z, signs.right_sigma);
    }
    right += likelihood;
    mean += likelihood * z;
  }
  EXPECT_NEAR(belief.log_odds, 0.3 + std::log(right / wrong), 1e-6);
  EXPECT_NEAR(belief.quality.mean, mean / right, 1e-6);
}

TEST(LocalizedBelief, HoldsAPoorSignAgainstAGoodDrawingMoreThanAgainstAPoorOne) {
  const LocalizedParams params = plain_params();
  const auto after = [&](double usual) {
    LocalizedBelief belief;
    for (int i = 0; i < 20; ++i) {
      belief.add({.way_m = 0.1, .new_share = 0.5, .inlier_probability = usual}, params);
    }
    const double before = belief.log_odds;
    belief.add({.way_m = 0.1, .new_share = 0.5, .inlier_probability = 0.5}, params);
    return belief.log_odds - before;
  };
  EXPECT_LT(after(0.99), after(0.8));
  EXPECT_LT(after(0.99), 0.0);
}

TEST(LocalizedBelief, ForgetsTheQualityWithTheWay) {
  const LocalizedParams params = plain_params();
  LocalizedBelief belief{.log_odds = 30.0};
  belief.add({.inlier_probability = 0.1}, params);
  EXPECT_LT(belief.quality.mean, -0.3);
  EXPECT_LT(belief.quality.variance, 1.0);
  belief.add({.way_m = 5000.0}, params);
  EXPECT_NEAR(belief.quality.mean, 0.0, 1e-6);
  EXPECT_NEAR(belief.quality.variance, 1.0, 1e-6);
}

/// A pose that was found lies in a part of the drawing that nothing is known of.
TEST(LocalizedBelief, KnowsNoQualityOfWhereItWasFound) {
  LocalizedParams params = plain_params();
  params.registered.quality_way_m = 1e12;
  params.found_way_m = 1.0;
  LocalizedBelief belief{.log_odds = -15.0, .quality = {.mean = -2.0, .variance = 0.1}};
  belief.add({.way_m = 5.0}, params);
  EXPECT_GT(belief.log_odds, 3.0);
  EXPECT_NEAR(belief.quality.mean, 0.0, 1e-4);
  EXPECT_NEAR(belief.quality.variance, 1.0, 1e-4);
}

TEST(LocalizedBelief, HearsNoMoreFromOneStepThanItMay) {
  LocalizedParams params = plain_params();
  params.max_ratio = 1.5;
  LocalizedBelief belief;
  belief.add({.inlier_probability = 0.0}, params);
  EXPECT_NEAR(belief.log_odds, -1.5, 1e-6);
}

TEST(LocalizedBelief, ForgetsWithTheWayDriven) {
  LocalizedParams params = plain_params();
  params.lost_way_m = 100.0;
  params.found_way_m = 300.0;
  params.beams = {};
  LocalizedBelief belief{.log_odds = 8.0};
  for (int metre = 0; metre < 3000; ++metre) {
    belief.add({.way_m = 1.0}, params);
  }
  // Balance: p (1 - exp(-1/100)) = (1 - p) (1 - exp(-1/300)).
  const double lost = -std::expm1(-0.01);
  const double found = -std::expm1(-1.0 / 300.0);
  EXPECT_NEAR(probability(belief), found / (lost + found), 1e-6);
}

TEST(LocalizedBelief, DropsWhereTwoScansContradictEachOther) {
  LocalizedParams params = plain_params();
  params.carried_contradiction = 0.2;
  params.carried_slope = 50.0;
  LocalizedBelief belief{.log_odds = 5.0};
  belief.add_contradiction(0.0, params);
  EXPECT_NEAR(belief.log_odds, 5.0, 0.01);
  belief.add_contradiction(0.2, params);
  EXPECT_NEAR(probability(belief), 0.5, 0.01);
  belief.add_contradiction(1.0, params);
  EXPECT_LT(probability(belief), 1e-6);
  EXPECT_TRUE(std::isfinite(belief.log_odds));
}

/// Draws from the model itself: stated probabilities must be the shares that are right.
TEST(LocalizedBeliefStatistical, IsCalibratedWhereItsModelHolds) {
  LocalizedParams params = plain_params();
  params.lost_way_m = 40.0;
  params.found_way_m = 20.0;
  params.beams = {.bias = 0.0, .evidence = 2.0};  // evidence N(+-1, 1): log ratio 2 e
  const double lost = -std::expm1(-1.0 / params.lost_way_m);
  const double found = -std::expm1(-1.0 / params.found_way_m);
  constexpr int kRuns = 4000;
  std::array<double, 5> stated{};
  std::array<double, 5> right_count{};
  std::array<double, 5> variance{};
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    Rng rng = make_rng(5, run);
    bool right = uniform(rng) < 0.5;
    LocalizedBelief belief;
    for (int step = 0; step < 30; ++step) {
      right = right ? uniform(rng) >= lost : uniform(rng) < found;
      const double evidence = (right ? 1.0 : -1.0) + gaussian(1.0, rng);
      belief.add({.way_m = 1.0, .evidence = evidence}, params);
    }
    const double p = probability(belief);
    const auto bin = std::min<std::size_t>(static_cast<std::size_t>(5.0 * p), 4);
    stated[bin] += p;
    right_count[bin] += right ? 1.0 : 0.0;
    variance[bin] += p * (1.0 - p);
  }
  for (std::size_t bin = 0; bin < stated.size(); ++bin) {
    EXPECT_LT(std::abs(right_count[bin] - stated[bin]), 5.0 * std::sqrt(variance[bin]) + 1e-9)
        << "bin " << bin;
  }
}

TEST(ShareWithinBounds, CountsPlaceAndHeading) {
  ParticleSet particles;
  particles.resize(4);
  for (std::size_t i = 0; i < 4; ++i) {
    particles.x_px[i] = i == 1 ? 25.0F : 0.0F;  // 2.5 m away
    particles.y_px[i] = 0.0F;
    particles.heading_rad[i] = i == 2 ? 1.0F : 0.0F;
    particles.log_weight[i] = 0.0F;
  }
  EXPECT_EQ(share_within_bounds(particles, Sim2::from_xy_yaw_scale(0.0, 0.0, 0.0, 10.0), {}), 0.5);
}

TEST(LocalizedParams, RefuseWhatIsOutOfRange) {
  EXPECT_THROW(validate(LocalizedParams{.bound_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(LocalizedParams{.lost_way_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(LocalizedParams{.carried_contradiction = 2.0}), std::invalid_argument);
  EXPECT_THROW(validate(LocalizedParams{.registered = {.right_sigma = 0.0}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "filter/resample.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sketchloc {
namespace {

ParticleSet weighted(const std::vector<float>& weights) {
  ParticleSet particles;
  particles.resize(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    particles.log_weight[i] = std::log(weights[i]);
  }
  return particles;
}

TEST(Normalise, MakesTheMeanWeightOne) {
  ParticleSet particles = weighted({1.0F, 3.0F});
  const WeightSummary summary = normalise(particles);
  EXPECT_NEAR(summary.log_mean, std::log(2.0), 1e-6);
  EXPECT_NEAR(summary.effective_particles, 16.0 / 10.0, 1e-6);  // (1 + 3)^2 / (1 + 9)
  EXPECT_NEAR(std::exp(particles.log_weight[1]), 1.5, 1e-6);
}

TEST(Normalise, MakesAllEqualWhereNothingIsLeft) {
  ParticleSet particles = weighted({0.0F, 0.0F, 0.0F});
  particles.log_weight[1] = std::numeric_limits<float>::quiet_NaN();
  const WeightSummary summary = normalise(particles);
  EXPECT_EQ(summary.log_mean, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(summary.effective_particles, 3.0);
  EXPECT_EQ(particles.log_weight[1], 0.0F);
}

TEST(Normalise, TakesNanForNoWeight) {
  ParticleSet particles = weighted({1.0F, 1.0F});
  particles.log_weight[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(normalise(particles).effective_particles, 1.0, 1e-6);
}

TEST(Normalise, StandsHugeAndTinyWeights) {
  ParticleSet particles = weighted({1.0F, 1.0F});
  particles.log_weight = {5000.0F, 5000.0F};
  EXPECT_NEAR(normalise(particles).log_mean, 5000.0, 1e-3);
  particles.log_weight = {-5000.0F, -5000.0F};
  EXPECT_NEAR(normalise(particles).effective_particles, 2.0, 1e-6);
}

TEST(SystematicParents, GivesEachParentItsShareRoundedUpOrDown) {
  const std::vector<float> log_weight = {std::log(0.5F), std::log(1.5F), std::log(2.0F)};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::array<std::uint32_t, 10> parents{};
    Rng rng = make_rng(seed);
    systematic_parents(log_weight, parents, rng);
    std::array<int, 3> children{};
    for (const std::uint32_t parent : parents) {
      ++children[parent];
    }
    EXPECT_TRUE(children[0] == 1 || children[0] == 2);  // 10 * 0.125
    EXPECT_TRUE(children[1] == 3 || children[1] == 4);  // 10 * 0.375
    EXPECT_EQ(children[2], 5);                          // 10 * 0.5
  }
}

TEST(SystematicParents, NeverPicksAParentWithoutWeight) {
  const std::vector<float> log_weight = {-std::numeric_limits<float>::infinity(), 0.0F,
                                         -std::numeric_limits<float>::infinity()};
  std::array<std::uint32_t, 7> parents{};
  Rng rng = make_rng(3);
  systematic_parents(log_weight, parents, rng);
  for (const std::uint32_t parent : parents) {
    EXPECT_EQ(parent, 1U);
  }
}

TEST(SystematicParentsStatistical, AreUnbiasedForAnyCount) {
  const std::vector<float> log_weight = {std::log(0.2F), std::log(0.8F)};
  constexpr int kRuns = 20000;
  int light = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::array<std::uint32_t, 3> parents{};
    Rng rng = make_rng(11, static_cast<std::uint64_t>(run));
    systematic_parents(log_weight, parents, rng);
    for (const std::uint32_t parent : parents) {
      light += parent == 0 ? 1 : 0;
    }
  }
  // Children of the light one: 0.6 on average, 0 or 1, so the variance is 0.24.
  EXPECT_NEAR(light / static_cast<double>(kRuns), 0.6, 5.0 * std::sqrt(0.24 / kRuns));
}

TEST(KldCount, MatchesTheFormulaWorkedOutByHand) {
  // k = 11 bins: 10 / (2 * 0.05) * (1 - 2/90 + sqrt(2/90) * 2.326)^3
  //            = 100 * (0.977778 + 0.346740)^3 = 232.36
  const KldParams params{
      .error = 0.05, .quantile = 2.326, .min_particles = 1, .max_particles = 100000};
  EXPECT_EQ(kld_count(11, params), 233U);
}

TEST(KldCount, StaysWithinItsLimitsAndGrowsWithTheBins) {
  const KldParams params{.error = 0.05, .min_particles = 100, .max_particles = 1000};
  EXPECT_EQ(kld_count(0, params), 100U);
  EXPECT_EQ(kld_count(1, params), 100U);
  EXPECT_EQ(kld_count(1000000, params), 1000U);
  EXPECT_LT(kld_count(10, params), kld_count(20, params));
}

TEST(KldParams, RefuseAMaximumBelowTheMinimum) {
  EXPECT_THROW(validate(KldParams{.min_particles = 10, .max_particles = 9}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "motion/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "tests/support/moments.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kDraws = 200'000;

template <typename Draw>
std::vector<double> draws(std::uint64_t seed, const Draw& draw) {
  Rng rng = make_rng(seed);
  std::vector<double> values(kDraws);
  for (double& value : values) {
    value = draw(rng);
  }
  return values;
}

/// Five standard errors of a share estimated from kDraws draws.
double share_tolerance(double share) {
  return 5.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(kDraws));
}

TEST(Rng, DrawsTheWordsOfXoshiro256PlusPlusSeededBySplitMix) {
  Rng rng = make_rng(0);  // worked out by an independent program
  EXPECT_EQ(rng(), 0x3ed1653f0682083aULL);
  EXPECT_EQ(rng(), 0x852cecd8e7418ff7ULL);
  EXPECT_EQ(rng(), 0x8deb058ebaf6ffc3ULL);
  Rng other = make_rng(42, 7, 3);
  EXPECT_EQ(other(), 0xb4a8c37ad1d8b7abULL);
  EXPECT_EQ(other(), 0xb3f00a710e251c89ULL);
}

TEST(Rng, RepeatsItselfFromTheSameSeedStepAndChunk) {
  Rng first = make_rng(1, 2, 3);
  Rng second = make_rng(1, 2, 3);
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(first(), second());
  }
}

TEST(Rng, HasAStreamOfItsOwnForEverySeedStepAndChunk) {
  std::set<std::uint64_t> first_words;
  constexpr std::uint64_t kSide = 30;
  for (std::uint64_t seed = 0; seed < kSide; ++seed) {
    for (std::uint64_t step = 0; step < kSide; ++step) {
      for (std::uint64_t chunk = 0; chunk < kSide; ++chunk) {
        first_words.insert(make_rng(seed, step, chunk)());
      }
    }
  }
  EXPECT_EQ(first_words.size(), kSide * kSide * kSide);
}

TEST(Uniform, StaysInItsHalfOpenRange) {
  Rng rng = make_rng(8);
  for (int i = 0; i < 10'000; ++i) {
    const double unit = uniform(rng);
    ASSERT_TRUE(unit >= 0.0 && unit < 1.0);
    const double narrow = uniform(1.0, std::nextafter(1.0, 2.0), rng);  // rounding reaches the end
    ASSERT_EQ(narrow, 1.0);
  }
}

TEST(Gaussian, WithoutSpreadIsZero) {
  Rng rng = make_rng(9);
  EXPECT_EQ(gaussian(0.0, rng), 0.0);
}

TEST(Gaussian, KeepsNothingBetweenCalls) {
  Rng first = make_rng(10);
  Rng second = make_rng(10);
  gaussian(1.0, first);
  gaussian(5.0, second);
  EXPECT_EQ(first(), second());
}

TEST(UniformStatistical, HasMeanAndVarianceOfTheUnitInterval) {
  const auto values = draws(11, [](Rng& rng) { return uniform(rng); });
  const testing::SampleMoments found = testing::sample_moments(values);
  EXPECT_NEAR(found.mean, 0.5, 5.0 * found.mean_error);
  EXPECT_NEAR(found.variance, 1.0 / 12.0, 5.0 * found.variance_error);
}

TEST(UniformStatistical, FillsEveryBinAlike) {
  constexpr std::size_t kBins = 64;
  std::vector<double> counts(kBins);
  for (const double value : draws(12, [](Rng& rng) { return uniform(rng); })) {
    counts[static_cast<std::size_t>(value * static_cast<double>(kBins))] += 1.0;
  }
  const double expected = static_cast<double>(kDraws) / static_cast<double>(kBins);
  double chi_square = 0.0;
  for (const double count : counts) {
    chi_square += (count - expected) * (count - expected) / expected;
  }
  const double freedom = static_cast<double>(kBins - 1);  // mean k, variance 2 k
  EXPECT_NEAR(chi_square, freedom, 5.0 * std::sqrt(2.0 * freedom));
}

TEST(UniformStatistical, DoesNotRememberTheDrawBefore) {
  const auto values = draws(13, [](Rng& rng) { return uniform(rng) - 0.5; });
  std::vector<double> products;
  for (std::size_t i = 1; i < values.size(); i += 2) {
    products.push_back(values[i - 1] * values[i]);
  }
  const testing::SampleMoments found = testing::sample_moments(products);
  EXPECT_NEAR(found.mean, 0.0, 5.0 * found.mean_error);
}

TEST(UniformStatistical, IsIndependentBetweenNeighbouringChunksAndSteps) {
  std::vector<double> over_chunks;
  std::vector<double> over_steps;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Rng here = make_rng(14, i, i);
    Rng next_chunk = make_rng(14, i, i + 1);
    Rng next_step = make_rng(14, i + 1, i);
    const double value = uniform(here) - 0.5;
    over_chunks.push_back(value * (uniform(next_chunk) - 0.5));
    over_steps.push_back(value * (uniform(next_step) - 0.5));
  }
  for (const std::vector<double>& products : {over_chunks, over_steps}) {
    const testing::SampleMoments found = testing::sample_moments(products);
    EXPECT_NEAR(found.mean, 0.0, 5.0 * found.mean_error);
  }
}

TEST(GaussianStatistical, HasTheStatedMomentsAndTails) {
  constexpr double kSigma = 3.0;
  const auto values = draws(15, [](Rng& rng) { return gaussian(kSigma, rng); });
  const testing::SampleMoments found = testing::sample_moments(values);
  EXPECT_NEAR(found.mean, 0.0, 5.0 * found.mean_error);
  EXPECT_NEAR(found.variance, kSigma * kSigma, 5.0 * found.variance_error);
  for (const double sigmas : {0.5, 1.0, 2.0, 3.0}) {
    double inside = 0.0;
    for (const double value : values) {
      inside += std::abs(value) <= sigmas * kSigma ? 1.0 : 0.0;
    }
    const double share = std::erf(sigmas / std::sqrt(2.0));
    EXPECT_NEAR(inside / static_cast<double>(kDraws), share, share_tolerance(share)) << sigmas;
  }
}

TEST(GaussianStatistical, IsSymmetric) {
  double positive = 0.0;
  for (const double value : draws(16, [](Rng& rng) { return gaussian(1.0, rng); })) {
    positive += value > 0.0 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(positive / static_cast<double>(kDraws), 0.5, share_tolerance(0.5));
}

}  // namespace
}  // namespace sketchloc

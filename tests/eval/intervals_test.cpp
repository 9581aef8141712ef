#include "eval/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace sketchloc {
namespace {

// For z^2 = 3.841459: (8 + z^2 / 2) / (10 + z^2) = 0.716740, half width 0.226578.
TEST(WilsonInterval, MeetsTheValueWorkedOutByHand) {
  const Interval interval = wilson_interval(8, 10);
  EXPECT_NEAR(interval.low, 0.4901624715, 1e-9);
  EXPECT_NEAR(interval.high, 0.9433178485, 1e-9);
}

// Without successes the upper end is z^2 / (n + z^2).
TEST(WilsonInterval, StaysInsideZeroAndOne) {
  const double z_squared = 3.841458820694124;
  EXPECT_EQ(wilson_interval(0, 20).low, 0.0);
  EXPECT_NEAR(wilson_interval(0, 20).high, z_squared / (20.0 + z_squared), 1e-12);
  EXPECT_EQ(wilson_interval(200, 200).high, 1.0);
  EXPECT_NEAR(wilson_interval(200, 200).low, 200.0 / (200.0 + z_squared), 1e-12);
}

TEST(WilsonInterval, KnowsNothingWithoutTrials) {
  EXPECT_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1.0);
}

TEST(BootstrapInterval, OfEqualValuesIsThatValue) {
  Rng rng = make_rng(1);
  const Interval interval = bootstrap_interval(std::vector<double>(5, 2.0), {}, rng);
  EXPECT_DOUBLE_EQ(interval.low, 2.0);
  EXPECT_DOUBLE_EQ(interval.high, 2.0);
}

TEST(BootstrapInterval, GivesTheSameIntervalForTheSameSeed) {
  const std::vector<double> values = {1.0, 4.0, 2.0, 8.0};
  Rng first = make_rng(7);
  Rng second = make_rng(7);
  EXPECT_EQ(bootstrap_interval(values, {}, first).low, bootstrap_interval(values, {}, second).low);
}

TEST(BootstrapInterval, SaysWhichParameterIsOutOfRange) {
  Rng rng = make_rng(1);
  const std::vector<double> values = {1.0};
  EXPECT_THROW(bootstrap_interval(values, {.confidence = 1.5}, rng), std::invalid_argument);
  EXPECT_THROW(bootstrap_interval(values, {.resamples = 0}, rng), std::invalid_argument);
}

// Both methods vary by 10 over the inputs, but the first is always 1 better.
TEST(PairedInterval, DropsTheSpreadBetweenTheInputs) {
  const std::vector<double> first = {1.0, 11.0, 5.0, 8.0};
  const std::vector<double> second = {2.0, 12.0, 6.0, 9.0};
  Rng rng = make_rng(3);
  const Interval interval = paired_interval(first, second, {}, rng);
  EXPECT_DOUBLE_EQ(interval.low, -1.0);
  EXPECT_DOUBLE_EQ(interval.high, -1.0);
}

// The 95 % interval of a mean of 100 standard normals covers 0 in about 95 % of 400 repetitions;
// five standard errors of that rate are 5 sqrt(0.95 * 0.05 / 400) = 0.0545.
TEST(BootstrapIntervalStatistical, CoversTheTruthAboutAsOftenAsItSays) {
  constexpr int kRepetitions = 400;
  int covered = 0;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    Rng rng = make_rng(11, static_cast<std::uint64_t>(repetition));
    std::vector<double> values(100);
    for (double& value : values) {
      value = gaussian(1.0, rng);
    }
    const Interval interval = bootstrap_interval(values, {.resamples = 400}, rng);
    covered += interval.low <= 0.0 && 0.0 <= interval.high ? 1 : 0;
  }
  const double rate = covered / static_cast<double>(kRepetitions);
  EXPECT_NEAR(rate, 0.95, 5.0 * std::sqrt(0.95 * 0.05 / kRepetitions));
}

}  // namespace
}  // namespace sketchloc

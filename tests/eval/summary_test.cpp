#include "eval/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sketchloc {
namespace {

constexpr double kTolerance = 1e-12;

TEST(Summary, GivesTheFiveNumbersWorkedOutByHand) {
  const std::vector<double> errors = {0.3, 0.0, 0.4, 0.0};
  const auto summary = summarize(errors);
  ASSERT_TRUE(summary.has_value());
  EXPECT_NEAR(summary->mean, 0.175, kTolerance);
  EXPECT_NEAR(summary->median, 0.15, kTolerance);
  EXPECT_NEAR(summary->rmse, 0.25, kTolerance);
  EXPECT_NEAR(summary->p90, 0.37, kTolerance);  // position 0.9 * 3 = 2.7 in {0, 0, 0.3, 0.4}
  EXPECT_NEAR(summary->max, 0.4, kTolerance);
  EXPECT_EQ(summary->count, 4U);
}

TEST(Summary, OfOneErrorIsThatError) {
  const auto summary = summarize(std::vector<double>{2.5});
  ASSERT_TRUE(summary.has_value());
  for (const double value :
       {summary->mean, summary->median, summary->rmse, summary->p90, summary->max}) {
    EXPECT_DOUBLE_EQ(value, 2.5);
  }
}

TEST(Summary, OfNothingIsNone) { EXPECT_FALSE(summarize({}).has_value()); }

TEST(Summary, TakesTheMiddleValueOfAnOddCount) {
  EXPECT_DOUBLE_EQ(summarize(std::vector<double>{9.0, 1.0, 2.0})->median, 2.0);
}

TEST(Summary, ScalesEveryNumberButTheCount) {
  const ErrorSummary scaled_summary = scaled(*summarize(std::vector<double>{1.0, 3.0}), 10.0);
  EXPECT_DOUBLE_EQ(scaled_summary.mean, 20.0);
  EXPECT_DOUBLE_EQ(scaled_summary.median, 20.0);
  EXPECT_NEAR(scaled_summary.rmse, 10.0 * std::sqrt(5.0), kTolerance);
  EXPECT_DOUBLE_EQ(scaled_summary.max, 30.0);
  EXPECT_EQ(scaled_summary.count, 2U);
}

TEST(Quantile, ReachesTheSmallestAndTheLargestValue) {
  const std::vector<double> values = {5.0, -1.0, 3.0};
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), -1.0);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 5.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1.0);
}

TEST(ShareWithin, CountsTheBoundItselfAsWithin) {
  const std::vector<double> values = {0.5, 1.0, 1.5, 3.0};
  EXPECT_DOUBLE_EQ(share_within(values, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(share_within({}, 1.0), 0.0);
}

}  // namespace
}  // namespace sketchloc

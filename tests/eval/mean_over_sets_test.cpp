#include "eval/mean_over_sets.hpp"

#include <gtest/gtest.h>

namespace sketchloc {
namespace {

TEST(MeanOverSets, WeighsValuesAlikeAndTakesTheIntervalFromTheSets) {
  const std::vector<ValueOfSet> values = {{"a", 1.0}, {"a", 2.0}, {"b", 6.0}};
  Rng rng = make_rng(1);
  const MeanOverSets mean = mean_over_sets(values, rng);
  EXPECT_DOUBLE_EQ(mean.mean, 3.0);
  ASSERT_TRUE(mean.interval);
  EXPECT_DOUBLE_EQ(mean.interval->low, 1.5);   // both times a
  EXPECT_DOUBLE_EQ(mean.interval->high, 6.0);  // both times b
}

TEST(MeanOverSets, HasNoIntervalForASingleSet) {
  const std::vector<ValueOfSet> values = {{"a", 1.0}, {"a", 2.0}};
  Rng rng = make_rng(1);
  EXPECT_FALSE(mean_over_sets(values, rng).interval);
}

TEST(MeanOverSets, ComparesOnTheSetsThatBothHave) {
  const std::vector<ValueOfSet> values = {{"a", 1.0}, {"b", 2.0}, {"b", 4.0}, {"c", 100.0}};
  const std::vector<ValueOfSet> others = {{"b", 1.0}, {"a", 3.0}, {"a", 5.0}};
  Rng rng = make_rng(1);
  const MeanOverSets difference = mean_difference_over_sets(values, others, rng);
  EXPECT_DOUBLE_EQ(difference.mean, 0.5 * ((1.0 - 4.0) + (3.0 - 1.0)));
  ASSERT_TRUE(difference.interval);
  EXPECT_DOUBLE_EQ(difference.interval->low, -3.0);
  EXPECT_DOUBLE_EQ(difference.interval->high, 2.0);
}

TEST(MeanOverSets, IsZeroWhereNoSetIsCommon) {
  const std::vector<ValueOfSet> values = {{"a", 1.0}};
  const std::vector<ValueOfSet> others = {{"b", 1.0}};
  Rng rng = make_rng(1);
  const MeanOverSets difference = mean_difference_over_sets(values, others, rng);
  EXPECT_EQ(difference.mean, 0.0);
  EXPECT_FALSE(difference.interval);
}

}  // namespace
}  // namespace sketchloc

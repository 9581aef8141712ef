#include "registration/train/node_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "topology/place_comparator.hpp"

namespace sketchloc {
namespace {

/// How far the middles of a pair's nodes are apart, in m.
double apart_m(const PlaceBatch& batch, std::size_t pair) {
  const auto middle = [&](std::size_t row, std::size_t axis) {
    const float* node = batch.input.data() + row * kComparatorInputs;
    return 10.0 * 0.5 * (node[axis] + node[axis + 2]);
  };
  const auto other = static_cast<std::size_t>(batch.count) + pair;
  return std::hypot(middle(other, 0) - middle(pair, 0), middle(other, 1) - middle(pair, 1));
}

TEST(NodePairs, AreHalfOfOnePlaceAndHalfOfOthers) {
  const NodePairParams params;
  const PlaceBatch batch = node_pairs(params, SampleSplit::Training, 1, 0);
  ASSERT_EQ(batch.input.size(), 2U * 256 * kComparatorInputs);
  int same = 0;
  for (std::size_t i = 0; i < batch.answer.size(); ++i) {
    if (batch.answer[i] == 1) {
      ++same;
      EXPECT_LE(apart_m(batch, i), std::hypot(params.across_same_m, params.along_same_m) + 1e-4);
    } else {
      EXPECT_GE(apart_m(batch, i), params.across_least_m - 1e-4);
    }
  }
  EXPECT_EQ(same, 128);
}

TEST(NodePairs, AreAFunctionOfSeedSplitAndNumber) {
  const auto input = [](SampleSplit split, std::uint64_t seed, std::uint64_t number) {
    return node_pairs({}, split, seed, number).input;
  };
  const auto one = input(SampleSplit::Training, 1, 5);
  EXPECT_EQ(one, input(SampleSplit::Training, 1, 5));
  EXPECT_NE(one, input(SampleSplit::Validation, 1, 5));
  EXPECT_NE(one, input(SampleSplit::Training, 2, 5));
  EXPECT_NE(one, input(SampleSplit::Training, 1, 6));
}

TEST(NodePairs, RefuseParametersOutOfRange) {
  EXPECT_THROW(validate(NodePairParams{.across_least_m = 0.4}), std::invalid_argument);
  EXPECT_THROW(validate(NodePairParams{.shortest_m = 8.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

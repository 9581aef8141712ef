#include "registration/train/place_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace sketchloc {
namespace {

PlaceSampleParams small_params() {
  return {.scene = {.drive_m = 30.0},
          .look = {.window = {.side_m = 12.8, .cells = 32}},
          .scenes = 2,
          .samples_per_scene = 6,
          .batch = 4};
}

PlaceBatch batch(std::uint64_t number, SampleSplit split = SampleSplit::Training,
                 std::uint64_t seed = 3) {
  return PlaceSamples(small_params(), split, seed).batch(number);
}

TEST(PlaceSamples, AreAFunctionOfSeedSplitAndNumber) {
  PlaceSamples in_order(small_params(), SampleSplit::Training, 3);
  in_order.batch(0);
  const PlaceBatch second = in_order.batch(1);
  EXPECT_EQ(second.input, batch(1).input);
  EXPECT_EQ(second.answer, batch(1).answer);
  EXPECT_NE(second.input, batch(0).input);
  EXPECT_NE(second.input, batch(1, SampleSplit::Validation).input);
  EXPECT_NE(second.input, batch(1, SampleSplit::Training, 4).input);
}

TEST(PlaceSamples, HaveTwoPlanesAndALabelEach) {
  const PlaceBatch made = batch(0);
  EXPECT_EQ(made.count, 4);
  EXPECT_EQ(made.answer.size(), 4U);
  EXPECT_EQ(made.input.size(), 4U * 2 * 32 * 32);
  for (const std::int64_t answer : made.answer) {
    EXPECT_GE(answer, 0);
    EXPECT_LT(answer, static_cast<std::int64_t>(kPlaceLabels));
  }
  EXPECT_GT(*std::ranges::max_element(made.input), 0.9F);
}

TEST(PlaceSamples, RefuseParametersOutOfRange) {
  PlaceSampleParams params = small_params();
  params.office_share = 1.5;
  EXPECT_THROW(PlaceSamples(params, SampleSplit::Training, 1), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "registration/train/sample_source.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sketchloc {
namespace {

SampleSourceParams small_params() {
  return {.scene = {.home_share = 1.0, .office_share = 0.0, .drive_m = 10.0},
          .sample = {.cells = 32},
          .scenes = 2,
          .samples_per_scene = 6,
          .batch = 4};
}

std::vector<SampleBatch> batches(const SampleSource::Stream& stream, int threads, int count) {
  SampleSource source(small_params(), stream, threads);
  std::vector<SampleBatch> result;
  for (int i = 0; i < count; ++i) {
    result.push_back(source.next());
  }
  return result;
}

TEST(SampleSource, MakesTheSameSamplesOnAnyNumberOfThreads) {
  const std::vector<SampleBatch> one = batches({.seed = 3}, 1, 5);
  const std::vector<SampleBatch> two = batches({.seed = 3}, 2, 5);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].input, two[i].input);
    EXPECT_EQ(one[i].pose, two[i].pose);
    EXPECT_EQ(one[i].grid_shift, two[i].grid_shift);
  }
}

TEST(SampleSource, GoesOnFromAnyBatch) {
  const std::vector<SampleBatch> whole = batches({.seed = 3}, 1, 5);
  const std::vector<SampleBatch> rest = batches({.seed = 3, .first_batch = 4}, 2, 1);
  EXPECT_EQ(whole[4].input, rest[0].input);
  EXPECT_EQ(whole[4].pose, rest[0].pose);
}

TEST(SampleSource, NeverRepeatsItself) {
  const std::vector<SampleBatch> batch = batches({.seed = 3}, 1, 2);
  const SampleBatch validation =
      batches({.split = SampleSplit::Validation, .seed = 3}, 1, 1).front();
  EXPECT_NE(batch[0].pose, batch[1].pose);
  EXPECT_NE(batch[0].pose, validation.pose);
  EXPECT_NE(batch[0].pose, batches({.seed = 4}, 1, 1).front().pose);
}

TEST(SampleSource, EndsWhileItsThreadsAreAtWork) {
  SampleSource source(small_params(), {}, 2);  // nobody takes a batch
}

TEST(SampleSource, RefusesBatchesThatLeaveScenesOut) {
  SampleSourceParams params = small_params();
  params.batch = 5;
  EXPECT_THROW(SampleSource(params, {}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

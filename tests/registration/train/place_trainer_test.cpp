#include "registration/train/place_trainer.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "registration/train/node_pairs.hpp"
#include "registration/train/place_samples.hpp"
#include "registration/train/trainer.hpp"
#include "topology/place_classifier.hpp"
#include "topology/place_comparator.hpp"

namespace sketchloc {
namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

PlaceBatch pairs(std::uint64_t number) {
  return node_pairs({.batch = 32}, SampleSplit::Training, 1, number);
}

PlaceTrainer::Plan comparator_plan() {
  return {.task = PlaceTask::SamePlace, .cells = 1, .seed = 3, .total_batches = 40};
}

/// A scan that saw nothing.
PlacedScan alone() {
  static const Scan kScan;
  return {.scan = &kScan};
}

TEST(PlaceTrainer, LearnsToCompare) {
  set_learning_threads(1);
  PlaceTrainer trainer(comparator_plan(), {.warm_up_batches = 5, .averaging = 0.9});
  const std::vector<PlaceBatch> held_out = {node_pairs({}, SampleSplit::Validation, 0, 0)};
  const double before = trainer.validate(held_out).accuracy();
  double first_loss = 0.0;
  double last_loss = 0.0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    last_loss = trainer.learn(pairs(i));
    first_loss = i == 0 ? last_loss : first_loss;
  }
  EXPECT_LT(last_loss, 0.5 * first_loss);
  EXPECT_GT(trainer.validate(held_out).accuracy(), std::max(before, 0.9));
}

TEST(PlaceTrainer, GoesOnFromACheckpoint) {
  set_learning_threads(1);
  PlaceTrainer whole(comparator_plan(), {});
  PlaceTrainer part(comparator_plan(), {});
  whole.learn(pairs(0));
  part.learn(pairs(0));
  PlaceTrainer rest(comparator_plan(), {});
  rest.restore(part.checkpoint());
  EXPECT_EQ(rest.batches_learned(), 1U);
  EXPECT_EQ(whole.learn(pairs(1)), rest.learn(pairs(1)));
  PlaceTrainer other({.task = PlaceTask::Labels, .cells = 32}, {});
  EXPECT_THROW(other.restore(part.checkpoint()), std::runtime_error);
}

TEST(PlaceTrainer, ExportsWhatTheComparatorRuns) {
  set_learning_threads(1);
  PlaceTrainer trainer(comparator_plan(), {});
  trainer.learn(pairs(0));
  PlaceComparator comparator(bytes_of(onnx_bytes(trainer.folded())));
  EXPECT_EQ(comparator.distances(std::vector<NodeEndsPair>(3)).size(), 3U);
}

TEST(PlaceTrainer, ExportsWhatTheClassifierRuns) {
  set_learning_threads(1);
  const PlaceClassifierParams look{.window = {.side_m = 12.8, .cells = 32}};
  PlaceSamples samples({.scene = {.drive_m = 20.0}, .look = look, .scenes = 1, .batch = 8},
                       SampleSplit::Training, 1);
  PlaceTrainer trainer({.task = PlaceTask::Labels, .cells = 32, .total_batches = 4}, {});
  EXPECT_GT(trainer.learn(samples.batch(0)), 0.0);
  PlaceClassifier classifier(bytes_of(onnx_bytes(trainer.folded())), look);
  const PlaceProbabilities probabilities = classifier.classify(std::vector<PlacedScan>(1, alone()));
  EXPECT_NEAR(std::accumulate(probabilities.begin(), probabilities.end(), 0.0), 1.0, 1e-6);
}

}  // namespace
}  // namespace sketchloc

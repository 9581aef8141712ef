#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "registration/train/network_plan.hpp"
#include "registration/train/place_batch.hpp"
#include "registration/train/trainer_params.hpp"
#include "topology/confusion_matrix.hpp"

namespace sketchloc {

/// What networks learn about places. Those of [Topo20]: the kind of a place, or whether two nodes
/// are one place. `Verification`: whether the robot is where its scans were registered.
enum class PlaceTask { Labels, SamePlace, Verification };

/// `Labels`: convolutions over `cells` x `cells` cells, a multiple of 16. `SamePlace`: the
/// perceptron of [Topo20]; `cells` is 1. `Verification`: plan_verification.
NetworkPlan plan_network(PlaceTask task, int cells);

/// A network that learns about places. The same seed, batches and threads give the same bytes.
class PlaceTrainer {
 public:
  /// `total_batches`: when the learning rate is at its end.
  struct Plan {
    PlaceTask task = PlaceTask::Labels;
    int cells = 64;
    std::uint64_t seed = 1;
    std::uint64_t total_batches = 1;
    std::optional<FoldedNetwork> from = std::nullopt;  ///< begin there
  };

  PlaceTrainer(const Plan& plan, const TrainerParams& params);
  ~PlaceTrainer();
  PlaceTrainer(const PlaceTrainer&) = delete;
  PlaceTrainer& operator=(const PlaceTrainer&) = delete;

  /// The loss: cross entropy of labels and of right and wrong, or the bounded contrastive loss with
  /// margin 1 of pairs.
  double learn(const PlaceBatch& batch);
  std::uint64_t batches_learned() const;

  /// Pairs are called the same where they lie nearer than half of the margin.
  ConfusionMatrix validate(std::span<const PlaceBatch> batches) const;

  /// All that goes on learning needs, as bytes.
  std::string checkpoint() const;
  /// Throws std::runtime_error where the bytes are not of such a trainer.
  void restore(const std::string& checkpoint);

  /// The network as it would be used, batch normalisation folded in.
  FoldedNetwork folded() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sketchloc

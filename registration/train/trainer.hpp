#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "registration/train/network_plan.hpp"
#include "registration/train/sample_source.hpp"
#include "registration/train/trainer_params.hpp"
#include "registration/train/validation.hpp"

namespace sketchloc {

/// Loss of one step and its parts (those that the kind does not have are 0).
struct TrainingLoss {
  double total = 0.0;
  double grid = 0.0;
  double pose = 0.0;
  double spread = 0.0;
  double inlier = 0.0;
};

/// A network that learns. The same seed, batches and threads give the same bytes.
class Trainer {
 public:
  /// `total_batches`: when the learning rate is at its end; a resumed trainer may have another one.
  struct Plan {
    NetworkKind kind = NetworkKind::Ours;
    LocalWindow window{};
    std::uint64_t seed = 1;
    std::uint64_t total_batches = 1;
    std::optional<FoldedNetwork> from = {};  ///< a trained one of this kind to go on from
  };

  Trainer(const Plan& plan, const TrainerParams& params);
  ~Trainer();
  Trainer(const Trainer&) = delete;
  Trainer& operator=(const Trainer&) = delete;

  TrainingLoss learn(const SampleBatch& batch);
  std::uint64_t batches_learned() const;

  /// Rows of outputs of the network as it would be used.
  std::vector<float> predict(const SampleBatch& batch) const;
  ValidationReport validate(std::span<const SampleBatch> batches) const;

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

/// Threads of all learning in this program.
void set_learning_threads(int threads);

}  // namespace sketchloc

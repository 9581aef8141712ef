#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "registration/train/network_plan.hpp"
#include "registration/train/sample_source.hpp"
#include "registration/train/validation.hpp"

namespace sketchloc {

/// How a network learns.
struct TrainerParams {
  double learning_rate = 1e-3;       ///< of Adam at the start, > 0
  double last_learning_rate = 1e-5;  ///< at the end, in (0, learning_rate]
  int warm_up_batches = 400;         ///< the first ones, with a rising rate, >= 0
  /// Of all samples, the last ones, with a rate that falls linearly; in [0, 1]. Before them the
  /// rate does not depend on how many are to come, so that learning may be prolonged.
  double fall_share = 0.3;
  double averaging = 0.999;    ///< the network that is used follows by 1 - this, in [0, 1)
  double max_gradient = 10.0;  ///< longer gradients are shortened, > 0
};

template <typename Visitor>
void visit_fields(TrainerParams& trainer, Visitor&& visit) {
  visit("learning_rate", trainer.learning_rate);
  visit("last_learning_rate", trainer.last_learning_rate);
  visit("warm_up_batches", trainer.warm_up_batches);
  visit("fall_share", trainer.fall_share);
  visit("averaging", trainer.averaging);
  visit("max_gradient", trainer.max_gradient);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const TrainerParams& params);

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

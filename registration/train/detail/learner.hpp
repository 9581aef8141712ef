#pragma once

#include <torch/torch.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "registration/train/detail/torch_network.hpp"
#include "registration/train/trainer_params.hpp"

namespace sketchloc::detail {

/// A view on numbers, which must outlive it.
torch::Tensor view(const std::vector<float>& values, const std::vector<std::int64_t>& shape);

/// A network that learns by Adam, and the average of what it was lately: that one is used.
class Learner {
 public:
  struct Course {
    std::uint64_t seed = 1;           ///< of the network's first numbers
    std::uint64_t total_batches = 1;  ///< when the learning rate is at its end
  };
  using Loss = std::function<torch::Tensor(const torch::Tensor& output)>;

  Learner(const NetworkPlan& plan, const TrainerParams& params, const Course& course);
  /// Goes on from a trained network, with a course of its own.
  Learner(const FoldedNetwork& trained, const TrainerParams& params, const Course& course);

  /// One step down the loss of a batch, which is returned.
  double learn(const torch::Tensor& input, const Loss& loss);
  /// Rows of outputs of the network as it would be used.
  std::vector<float> predict(const torch::Tensor& input);

  std::uint64_t batches_learned() const { return batches_learned_; }
  FoldedNetwork folded() const { return average_.fold(); }

  std::string checkpoint() const;
  /// Throws std::runtime_error where the bytes are not of such a network.
  void restore(const std::string& checkpoint);

 private:
  Learner(TorchNetwork network, TorchNetwork average, const TrainerParams& params,
          const Course& course);

  void set_learning_rate();

  TrainerParams params_;
  Course course_;
  TorchNetwork network_;
  TorchNetwork average_;
  torch::optim::Adam optimizer_;
  std::uint64_t batches_learned_ = 0;
};

}  // namespace sketchloc::detail

#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/training_curve.hpp"
#include "registration/train/trainer_params.hpp"

namespace sketchloc {

/// How well a network does after some learning.
struct Measured {
  std::vector<double> columns;  ///< one for each name of LearningTask::columns()
  std::string summary;          ///< for people, one line
};

/// What every task needs to know.
struct LearningPlan {
  std::uint64_t seed = 1;
  std::uint64_t samples = 1;         ///< in all
  std::uint64_t validate_every = 1;  ///< samples
  int validation_batches = 1;
  int threads = 1;
  int workers = 1;  ///< threads that make samples
  TrainerParams trainer = {};
};

/// So many whole batches as hold a number of samples, at least one.
std::uint64_t batches_of(std::uint64_t samples, int samples_per_batch);

/// What `sketchloc train` can learn: a network, its samples, and how its progress is told.
class LearningTask {
 public:
  virtual ~LearningTask() = default;

  virtual int samples_per_batch() const = 0;
  virtual std::uint64_t batches_learned() const = 0;

  /// Before the first batch of a sitting, and after each point of the curve that another one
  /// follows. `point` has the network of the curve's last point, if there is one.
  virtual void go_on(const std::filesystem::path& point) = 0;
  virtual void learn_batch() = 0;

  /// The curve's columns after "samples" and "seconds".
  virtual std::vector<std::string_view> columns() const = 0;
  /// On held-out samples.
  virtual Measured measure() = 0;
  virtual std::vector<CurvePanel> panels() const = 0;

  virtual std::string checkpoint() const = 0;
  virtual void restore(const std::string& checkpoint) = 0;
  /// The bytes of an ONNX file.
  virtual std::string network() const = 0;
};

}  // namespace sketchloc

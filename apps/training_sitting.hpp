#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "apps/learning_task.hpp"
#include "apps/run_file.hpp"

namespace sketchloc {

/// What is learned in which folder, and how far.
struct TrainingSittingPlan {
  std::filesystem::path out;
  RunDescription made_by;
  std::uint64_t samples = 1;         ///< in all
  std::uint64_t stop_after = 0;      ///< samples; 0: at `samples`
  std::uint64_t validate_every = 1;  ///< samples
  bool resume = false;
  bool force = false;
};

/// One sitting of learning, from the last checkpoint in the folder to the end or to Ctrl-C. The
/// folder holds checkpoint.pt, network.onnx, curve.csv, curve.svg and run.yaml, each replaced
/// whole. Throws std::invalid_argument for a folder that is not empty where none of `resume` and
/// `force` is given, and Interrupted after Ctrl-C, with all saved.
void learn_in_folder(LearningTask& task, const TrainingSittingPlan& plan);

}  // namespace sketchloc

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "datasets/place_label.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// The files of a run whose poses know what kind of place they are at.
struct LabelledRunFiles {
  std::filesystem::path trajectory;  ///< TUM
  std::filesystem::path labels;      ///< CSV, see read_labels()
  std::filesystem::path reference;   ///< TUM; empty: none
};

struct LabelledRun {
  MetricTrajectory odometry;
  std::vector<PlaceLabel> labels;             ///< one for each pose
  std::optional<MetricTrajectory> reference;  ///< one for each pose
};

/// Throws std::runtime_error where a file cannot be read or is of another run.
LabelledRun read_labelled_run(const LabelledRunFiles& files);

}  // namespace sketchloc

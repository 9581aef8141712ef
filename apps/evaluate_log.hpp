#pragma once

#include <filesystem>
#include <string>

#include "datasets/sketch.hpp"
#include "eval/odometry_comparison.hpp"

namespace sketchloc {

/// What an evaluation found, for people and for scripts.
struct Evaluation {
  std::string table;
  std::string json;
};

/// The odometry of a CARMEN log, raw and matched, against the log's corrected poses and, unless the
/// path is empty, against relations.
Evaluation evaluate_odometry(const std::filesystem::path& log,
                             const std::filesystem::path& relations,
                             const OdometryComparisonParams& params);

/// How well the scans of a log fit a drawing where a reference has the robot.
Evaluation evaluate_scans(const std::filesystem::path& log, const Sketch& sketch,
                          const std::filesystem::path& reference);

}  // namespace sketchloc

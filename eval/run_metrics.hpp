#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/sketch_errors.hpp"
#include "eval/trajectory_errors.hpp"

namespace sketchloc {

/// What a run took.
struct RunCost {
  double seconds = 0.0;         ///< wall clock
  double peak_memory_mb = 0.0;  ///< peak resident set, 1 MB = 10^6 bytes
};

/// Results of one run in a drawing.
struct RunMetrics {
  std::size_t poses = 0;               ///< of the estimated trajectory
  std::optional<SketchErrors> errors;  ///< none without a reference
  std::optional<RunCost> cost;         ///< none where it was not measured
};

/// The text of `metrics.json`, see docs/metrics.md; null where nothing could be measured.
std::string to_json(const RunMetrics& metrics);

/// What a metrics.json of a run says about its errors: the shares within 1 m and 2 m, the medians,
/// the loss and the scored poses. Throws std::runtime_error with file and key where one is missing
/// or the run had no reference.
SketchErrors read_run_errors(const std::filesystem::path& json);

/// Relative errors over one delta.
struct RelativeErrors {
  RelativeErrorParams params;
  PoseErrors errors;
};

/// Results of a metric trajectory against a reference.
struct TrajectoryMetrics {
  std::size_t poses = 0;    ///< of the estimated trajectory
  std::size_t matched = 0;  ///< of them with a reference pose
  PoseErrors unaligned;
  PoseErrors first_pose;
  PoseErrors se2;
  PoseErrors sim2;
  std::vector<RelativeErrors> relative;
};

/// Absolute errors in all alignments and relative errors over each delta.
TrajectoryMetrics measure_trajectory(const MetricTrajectory& reference,
                                     const MetricTrajectory& estimate, double max_gap_s,
                                     const std::vector<RelativeErrorParams>& relative);

/// The text of `metrics.json` of a metric trajectory, see docs/metrics.md.
std::string to_json(const TrajectoryMetrics& metrics);

}  // namespace sketchloc

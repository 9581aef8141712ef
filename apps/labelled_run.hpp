#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "datasets/io/run_io.hpp"
#include "datasets/place_label.hpp"
#include "datasets/scan.hpp"
#include "motion/trajectory.hpp"
#include "registration/odometry_feed.hpp"
#include "topology/place_classifier.hpp"

namespace sketchloc {

/// The files of a run whose poses know what kind of place they are at: a trajectory with labels, or
/// a log whose scans tell.
struct LabelledRunFiles {
  std::filesystem::path trajectory = {};              ///< TUM; empty: there is a log
  std::filesystem::path log = {};                     ///< empty: there is a trajectory
  OdometrySource odometry = OdometrySource::Matched;  ///< of the log
  RunReading reading = {};                            ///< of the log
  std::filesystem::path labels = {};   ///< CSV, see read_labels(); with a log it may be empty
  std::filesystem::path network = {};  ///< tells labels from scans; empty: the one that is shipped
  std::filesystem::path reference = {};         ///< TUM; empty: none
  std::filesystem::path reference_labels = {};  ///< CSV; empty: none
};

struct LabelledRun {
  MetricTrajectory odometry;                                     ///< of a log: matched
  std::vector<PlaceLabel> labels;                                ///< one for each pose
  std::vector<Scan> scans = {};                                  ///< one for each pose, or none
  std::vector<Se2> raw_odom_from_robot = {};                     ///< of a log, as the wheels say
  std::optional<MetricTrajectory> reference = {};                ///< one for each pose
  std::optional<std::vector<PlaceLabel>> reference_labels = {};  ///< one for each pose
};

/// Throws std::runtime_error where a file cannot be read or is of another run.
LabelledRun read_labelled_run(const LabelledRunFiles& files,
                              const PlaceClassifierParams& classifier = {});

}  // namespace sketchloc

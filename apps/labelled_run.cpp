#include "apps/labelled_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <stdexcept>
#include <utility>

#include "apps/inputs.hpp"
#include "apps/progress.hpp"
#include "apps/read_bytes.hpp"
#include "datasets/io/labels_io.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "registration/matched_odometry.hpp"
#include "registration/shipped_networks.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

const fs::path& source_of(const LabelledRunFiles& files) {
  return files.log.empty() ? files.trajectory : files.log;
}

/// Throws where a file does not have one entry for each pose of the run.
void require_as_many(std::size_t entries, const fs::path& file, const LabelledRun& run,
                     const LabelledRunFiles& files, const char* what_to_do) {
  if (entries != run.odometry.size()) {
    throw std::runtime_error(fmt::format("{}: {} entries, but {} has {} poses; {}", file.string(),
                                         entries, source_of(files).string(), run.odometry.size(),
                                         what_to_do));
  }
}

std::vector<PlaceLabel> read_labels_of(const fs::path& file, const LabelledRun& run,
                                       const LabelledRunFiles& files) {
  std::vector<PlaceLabel> labels = read_labels(file);
  require_as_many(labels.size(), file, run, files, "give one label for each pose");
  return labels;
}

MetricTrajectory read_reference_of(const LabelledRun& run, const LabelledRunFiles& files) {
  MetricTrajectory reference = read_tum(files.reference);
  require_as_many(reference.size(), files.reference, run, files,
                  "give the reference of this run, pose by pose");
  for (std::size_t i = 0; i < run.odometry.size(); ++i) {
    if (run.odometry[i].time_s != reference[i].time_s) {
      throw std::runtime_error(
          fmt::format("{}: pose {} is of time {}, that of {} of time {}; give the reference of "
                      "this run, pose by pose",
                      files.reference.string(), i, reference[i].time_s, source_of(files).string(),
                      run.odometry[i].time_s));
    }
  }
  return reference;
}

/// Returns the odometry as refined by the scans, whatever the run's is.
std::vector<Se2> read_scans(LabelledRun& run, const LabelledRunFiles& files) {
  const Run log = read_log_input(files.log, files.reading);
  MatchedOdometry matched;
  std::vector<Se2> matched_from_robot;
  Progress progress("match", log.steps.size());
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    const auto& [scan, odom_from_robot] = log.steps[i];
    const bool again = !run.odometry.empty() && scan.time_s <= run.scans.back().time_s;
    if (!again) {  // poses of a trajectory have a time each
      matched_from_robot.push_back(matched.step(scan, odom_from_robot).odom_from_robot);
      run.odometry.append(scan.time_s, files.odometry == OdometrySource::Matched
                                           ? matched_from_robot.back()
                                           : odom_from_robot);
      run.raw_odom_from_robot.push_back(odom_from_robot);
      run.scans.push_back(scan);
    }
    progress.update(i + 1);
  }
  if (run.scans.size() < log.steps.size()) {
    warn_of(files.log, {fmt::format("{} scans of the same instant as others are left out",
                                    log.steps.size() - run.scans.size())});
  }
  return matched_from_robot;
}

PlaceClassifier classifier_of(const fs::path& network, const PlaceClassifierParams& params) {
  if (network.empty()) {
    return PlaceClassifier(shipped_place_classifier(), params);
  }
  const std::string bytes = bytes_of(network);
  try {
    return PlaceClassifier({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                           params);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("{}: {}; give the network.onnx of sketchloc train --network places, and "
                    "--classifier.window.* "
                    "as it was trained",
                    network.string(), error.what()));
  }
}

}  // namespace

LabelledRun read_labelled_run(const LabelledRunFiles& files,
                              const PlaceClassifierParams& classifier) {
  LabelledRun run;
  std::vector<Se2> matched_from_robot;
  if (files.log.empty()) {
    run.odometry = read_tum(files.trajectory);
  } else {
    matched_from_robot = read_scans(run, files);
  }
  if (files.labels.empty()) {
    PlaceClassifier told_by_scans = classifier_of(files.network, classifier);
    run.labels = classify_places(told_by_scans, run.scans, matched_from_robot);
  } else {
    run.labels = read_labels_of(files.labels, run, files);
  }
  if (!files.reference.empty()) {
    run.reference = read_reference_of(run, files);
  }
  if (!files.reference_labels.empty()) {
    run.reference_labels = read_labels_of(files.reference_labels, run, files);
  }
  return run;
}

}  // namespace sketchloc

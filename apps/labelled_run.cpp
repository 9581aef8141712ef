#include "apps/labelled_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <stdexcept>

#include "datasets/io/labels_io.hpp"
#include "datasets/io/trajectory_io.hpp"

namespace sketchloc {
namespace {

/// Throws where a file does not have one entry for each pose of the trajectory.
void require_as_many(std::size_t entries, std::size_t poses, const std::filesystem::path& file,
                     const std::filesystem::path& trajectory, const char* what_to_do) {
  if (entries != poses) {
    throw std::runtime_error(fmt::format("{}: {} entries, but {} has {} poses; {}", file.string(),
                                         entries, trajectory.string(), poses, what_to_do));
  }
}

void require_same_times(const LabelledRun& run, const LabelledRunFiles& files) {
  for (std::size_t i = 0; i < run.odometry.size(); ++i) {
    if (run.odometry[i].time_s != (*run.reference)[i].time_s) {
      throw std::runtime_error(
          fmt::format("{}: pose {} is of time {}, that of {} of time {}; give the reference of "
                      "this run, pose by pose",
                      files.reference.string(), i, (*run.reference)[i].time_s,
                      files.trajectory.string(), run.odometry[i].time_s));
    }
  }
}

}  // namespace

LabelledRun read_labelled_run(const LabelledRunFiles& files) {
  LabelledRun run{.odometry = read_tum(files.trajectory),
                  .labels = read_labels(files.labels),
                  .reference = std::nullopt};
  require_as_many(run.labels.size(), run.odometry.size(), files.labels, files.trajectory,
                  "give one label for each pose");
  if (!files.reference.empty()) {
    run.reference = read_tum(files.reference);
    require_as_many(run.reference->size(), run.odometry.size(), files.reference, files.trajectory,
                    "give the reference of this run, pose by pose");
    require_same_times(run, files);
  }
  return run;
}

}  // namespace sketchloc

#include "eval/filter_pass.hpp"

#include <algorithm>

namespace sketchloc {
namespace {

constexpr std::size_t kSnapshots = 80;
constexpr std::size_t kParticlesShown = 400;

/// As many particles as one looks at, drawn by weight.
ParticleSnapshot snapshot_of(const ParticleSet& particles, std::size_t step, std::uint64_t seed) {
  constexpr std::uint64_t kPurpose = 1ULL << 32;  // far from the localizer's own streams
  Rng rng = make_rng(seed, kPurpose, step);
  std::vector<std::uint32_t> shown(std::min(kParticlesShown, particles.size()));
  systematic_parents(particles.log_weight, shown, rng);
  ParticleSnapshot snapshot{.step = step, .particles = {}};
  for (const std::uint32_t i : shown) {
    snapshot.particles.push_back({.x_px = particles.x_px[i],
                                  .y_px = particles.y_px[i],
                                  .yaw_rad = particles.heading_rad[i],
                                  .weight = 1.0F / static_cast<float>(shown.size())});
  }
  return snapshot;
}

/// The last scan where none has any.
const Scan& first_scan_with_returns(const Run& run) {
  for (const RunStep& step : run.steps) {
    if (!end_points_in_robot(step.scan).empty()) {
      return step.scan;
    }
  }
  return run.steps.back().scan;
}

}  // namespace

Localization filter_pass(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                         const LocalizationParams& params,
                         const std::function<void(std::size_t)>& progress) {
  Localization result;
  Localizer localizer(sketch, params.localizer, task.predictor);
  if (task.start_sketch_from_robot) {
    localizer.start_at(*task.start_sketch_from_robot);
  } else if (const GlobalStart start = localizer.start_anywhere(first_scan_with_returns(run));
             start != GlobalStart::Started) {
    result.status = start == GlobalStart::NoReturns ? Localization::Status::NoReturns
                                                    : Localization::Status::NoFreeSpace;
    return result;
  }
  OdometryFeed odometry(task.odometry, params.odometry);
  const std::size_t snapshot_every = run.steps.size() / kSnapshots + 1;
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const RunStep& step = run.steps[i];
    result.steps.push_back(localizer.step(step.scan, odometry.odom_from_robot(step)));
    if (i % snapshot_every == 0) {
      result.snapshots.push_back(snapshot_of(localizer.particles(), i, params.localizer.seed));
    }
    if (progress) {
      progress(i + 1);
    }
  }
  return result;
}

Run with_odometry(const Run& run, const LocalizationTask& task,
                  const MatchedOdometryParams& params) {
  OdometryFeed odometry(task.odometry, params);
  Run refined = run;
  for (RunStep& step : refined.steps) {
    step.odom_from_robot = odometry.odom_from_robot(step);
  }
  return refined;
}

}  // namespace sketchloc

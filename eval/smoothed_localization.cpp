#include "eval/smoothed_localization.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "eval/filter_pass.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr Around kSides[] = {Around::Before, Around::After, Around::Both};

/// The steps of a filter that starts where the robot ended and goes back to where it began.
std::vector<StepReport> filter_backwards(const Sketch& sketch, const Run& run,
                                         const LocalizationTask& task,
                                         const LocalizationParams& params,
                                         const std::function<void(std::size_t)>& progress) {
  Run back = run;
  std::ranges::reverse(back.steps);
  std::vector<StepReport> steps = filter_pass(sketch, back, task, params, [&](std::size_t done) {
                                    if (progress) {
                                      progress(run.steps.size() + done);
                                    }
                                  }).steps;
  std::ranges::reverse(steps);
  return steps;
}

/// The heaviest modes of both filters at each step.
std::vector<std::vector<Sim2>> modes_of(std::span<const StepReport> forward,
                                        std::span<const StepReport> backward, int most) {
  std::vector<std::vector<Sim2>> poses(forward.size());
  for (std::size_t step = 0; step < forward.size(); ++step) {
    for (const StepReport* report : {&forward[step], &backward[step]}) {
      const std::vector<Mode>& modes = report->estimate.modes;
      for (std::size_t i = 0; i < std::min(static_cast<std::size_t>(most), modes.size()); ++i) {
        poses[step].push_back(modes[i].sketch_from_robot);
      }
    }
  }
  return poses;
}

/// The keyframes of a run with what registering says at each, from the priors of its step.
KeyframeRun registered_keyframes(const Run& run, const std::vector<std::vector<Sim2>>& priors,
                                 const Sketch& sketch, const LocalizationTask& task,
                                 const KeyframeParams& params) {
  const SketchCropper drawing(sketch);
  KeyframeRun result{.start_sketch_from_robot = task.start_sketch_from_robot,
                     .keyframes = keyframes_of(run.steps, params)};
  for (Keyframe& keyframe : result.keyframes) {
    for (const Around side : kSides) {
      const std::vector<PoseHypothesis> found =
          register_at(submap_around(run.steps, keyframe.step, side, params.submap), drawing,
                      *task.predictor, priors[keyframe.step]);
      keyframe.hypotheses.insert(keyframe.hypotheses.end(), found.begin(), found.end());
    }
  }
  return result;
}

/// The filter's reports with the smoothed poses in the place of its own.
std::vector<StepReport> smoothed_steps(std::vector<StepReport> steps, const Run& run,
                                       const KeyframeRun& keyframes, const SmoothedRun& smoothed) {
  std::vector<Se2> odom_from_robot;
  for (const RunStep& step : run.steps) {
    odom_from_robot.push_back(step.odom_from_robot);
  }
  const std::vector<Sim2> poses = carried_poses(keyframes, smoothed.poses, odom_from_robot);
  std::size_t last = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    while (last + 1 < keyframes.keyframes.size() && keyframes.keyframes[last + 1].step <= i) {
      ++last;
    }
    SmoothedPose pose = smoothed.poses[last];
    pose.sketch_from_robot = poses[i];
    steps[i] = smoothed_report(std::move(steps[i]), pose);
  }
  return steps;
}

}  // namespace

StepReport smoothed_report(StepReport report, const SmoothedPose& pose) {
  report.estimate = {.sketch_from_robot = pose.sketch_from_robot,
                     .covariance = pose.covariance,
                     .modes = {{.sketch_from_robot = pose.sketch_from_robot,
                                .covariance = pose.covariance,
                                .weight = 1.0}}};
  report.localized_probability = pose.probability;
  report.share_within_bounds = 1.0;
  return report;
}

Localization localize_and_smooth(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                                 const LocalizationParams& params,
                                 const std::function<void(std::size_t)>& progress) {
  check(task.predictor != nullptr, "smoothing registers");
  const Run refined = with_odometry(run, task, params.odometry);
  LocalizationTask pass = task;
  pass.odometry = OdometrySource::Raw;  // it is refined already
  Localization result = filter_pass(sketch, refined, pass, params, progress);
  if (result.status != Localization::Status::Done) {
    return result;
  }
  pass.start_sketch_from_robot = result.steps.back().estimate.sketch_from_robot;
  const std::vector<StepReport> back = filter_backwards(sketch, refined, pass, params, progress);
  result.keyframes =
      registered_keyframes(refined, modes_of(result.steps, back, params.smoothing.max_modes),
                           sketch, task, params.smoothing.keyframes);
  if (params.smoothing.places) {
    result.keyframes.pairs =
        place_pairs(refined, result.keyframes.keyframes, params.smoothing.place_pairs);
  }
  const SmoothedRun smoothed = smooth(result.keyframes, params.smoothing.smoothing);
  if (smoothed.status == SmoothedRun::Status::Done) {
    result.filtered = result.steps;
    result.steps = smoothed_steps(std::move(result.steps), refined, result.keyframes, smoothed);
  }
  return result;
}

}  // namespace sketchloc

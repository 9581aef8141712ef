#include "eval/smoothed_localization.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "eval/filter_pass.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

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

/// The lag of a run that is smoothed afterwards: every pose is known once all of it is.
LagParams whole(LagParams lag) {
  lag.lag_m = std::numeric_limits<double>::max();
  return lag;
}

/// Smooths all that a smoother has seen of a run as one.
void smooth_whole(LagSmoother& smoother, const Run& run, const SmoothingPlan& plan,
                  Localization& result) {
  result.keyframes = smoother.known();
  if (plan.places) {
    result.keyframes.pairs = place_pairs(run, result.keyframes.keyframes, plan.place_pairs);
  }
  const SmoothedRun smoothed = smooth(result.keyframes, plan.smoothing);
  if (smoothed.status == SmoothedRun::Status::Done) {
    result.filtered = result.steps;
    result.steps = smoothed_steps(std::move(result.steps), run, result.keyframes, smoothed);
  }
}

}  // namespace

std::vector<PoseHypothesis> believed_by(const StepReport& report, int max_modes) {
  const std::vector<Mode>& modes = report.estimate.modes;
  std::vector<PoseHypothesis> believed;
  for (std::size_t i = 0; i < std::min(modes.size(), static_cast<std::size_t>(max_modes)); ++i) {
    believed.push_back(hypothesis_of(modes[i].sketch_from_robot, modes[i].covariance,
                                     report.localized_probability * modes[i].weight));
  }
  return believed;
}

StepBack filter_back(const Sketch& sketch, const LocalizerParams& params, WarpPredictor& predictor,
                     int max_modes) {
  const auto localizer = std::make_shared<Localizer>(sketch, params, &predictor);
  return [localizer, max_modes](const RunStep& step, const std::optional<Sim2>& start) {
    if (start) {
      localizer->start_at(*start);
    }
    std::vector<Sim2> poses;
    for (const PoseHypothesis& one :
         believed_by(localizer->step(step.scan, step.odom_from_robot), max_modes)) {
      poses.push_back(one.sketch_from_robot);
    }
    return poses;
  };
}

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
  check(task.predictor != nullptr && task.smoothing != Smoothing::None, "smoothing registers");
  const Run refined = with_odometry(run, task, params.odometry);
  LocalizationTask pass = task;
  pass.odometry = OdometrySource::Raw;  // it is refined already
  Localization result = filter_pass(sketch, refined, pass, params, progress);
  if (result.status != Localization::Status::Done) {
    return result;
  }
  const SmoothingPlan& plan = params.smoothing;
  const bool is_whole = task.smoothing == Smoothing::Whole;
  const SketchCropper drawing(sketch);
  LagSmoother smoother(
      {.drawing = drawing,
       .predictor = *task.predictor,
       .step_back = filter_back(sketch, params.localizer, *task.predictor, plan.max_modes)},
      {.lag = is_whole ? whole(plan.lag) : plan.lag,
       .keyframes = plan.keyframes,
       .smoothing = plan.smoothing,
       .max_modes = plan.max_modes},
      task.start_sketch_from_robot);
  std::vector<StepReport> lagged = result.steps;
  const auto keep = [&] {
    for (const LaggedPose& pose : smoother.take()) {
      lagged[pose.step] = smoothed_report(std::move(lagged[pose.step]), pose.pose);
    }
  };
  for (std::size_t i = 0; i < refined.steps.size(); ++i) {
    smoother.add(refined.steps[i], believed_by(result.steps[i], plan.max_modes));
    while (smoother.work()) {
    }
    keep();
    if (progress) {
      progress(refined.steps.size() + i + 1);
    }
  }
  if (is_whole) {
    smooth_whole(smoother, refined, plan, result);
    return result;
  }
  smoother.finish();
  keep();
  result.filtered = std::exchange(result.steps, std::move(lagged));
  return result;
}

}  // namespace sketchloc

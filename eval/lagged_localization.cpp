#include "eval/lagged_localization.hpp"

#include <algorithm>
#include <memory>

#include "eval/filter_pass.hpp"
#include "eval/smoothed_localization.hpp"
#include "motion/check.hpp"

namespace sketchloc {

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

Localization localize_with_lag(const Sketch& sketch, const Run& run, const LocalizationTask& task,
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
  const SketchCropper drawing(sketch);
  LagSmoother smoother({.drawing = drawing,
                        .predictor = *task.predictor,
                        .step_back = filter_back(sketch, params.localizer, *task.predictor,
                                                 params.smoothing.max_modes)},
                       {.lag = params.smoothing.lag,
                        .keyframes = params.smoothing.keyframes,
                        .smoothing = params.smoothing.smoothing,
                        .max_modes = params.smoothing.max_modes},
                       task.start_sketch_from_robot);
  result.filtered = result.steps;
  const auto keep = [&] {
    for (const LaggedPose& lagged : smoother.take()) {
      result.steps[lagged.step] = smoothed_report(result.steps[lagged.step], lagged.pose);
    }
  };
  for (std::size_t i = 0; i < refined.steps.size(); ++i) {
    smoother.add(refined.steps[i], believed_by(result.filtered[i], params.smoothing.max_modes));
    while (smoother.work()) {
    }
    keep();
  }
  smoother.finish();
  keep();
  return result;
}

}  // namespace sketchloc

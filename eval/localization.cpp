#include "eval/localization.hpp"

#include <algorithm>
#include <cmath>

#include "eval/filter_pass.hpp"
#include "eval/robot_finder.hpp"
#include "eval/smoothed_localization.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/ray_caster.hpp"

namespace sketchloc {
namespace {

StepReport report_of(std::size_t step, double time_s, const Sim2& sketch_from_robot) {
  StepReport report;
  report.step = step;
  report.time_s = time_s;
  report.estimate.sketch_from_robot = sketch_from_robot;
  report.estimate.covariance = Eigen::Matrix4d::Zero();
  return report;
}

Localization reckon(const Run& run, const LocalizationTask& task, const LocalizationParams& params,
                    const std::function<void(std::size_t)>& progress) {
  Localization result;
  if (!task.start_sketch_from_robot) {
    result.status = Localization::Status::NoStart;
    return result;
  }
  OdometryFeed odometry(task.odometry, params.odometry);
  std::optional<Se2> odom_from_start;
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const Se2 odom_from_robot = odometry.odom_from_robot(run.steps[i]);
    odom_from_start = odom_from_start.value_or(odom_from_robot);
    const Se2 start_from_robot = odom_from_start->inverse() * odom_from_robot;
    result.steps.push_back(
        report_of(i, run.steps[i].scan.time_s, *task.start_sketch_from_robot * start_from_robot));
    if (progress) {
      progress(i + 1);
    }
  }
  return result;
}

/// Registers now and then, and carries the pose on by odometry between.
Localization chain(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                   const LocalizationParams& params,
                   const std::function<void(std::size_t)>& progress) {
  check(task.predictor != nullptr, "a chain registers");
  Localization result;
  if (!task.start_sketch_from_robot) {
    result.status = Localization::Status::NoStart;
    return result;
  }
  RegistrationChain links(sketch, *task.predictor, params, *task.start_sketch_from_robot);
  OdometryFeed odometry(task.odometry, params.odometry);
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const Scan& scan = run.steps[i].scan;
    const bool registered = links.step(scan, odometry.odom_from_robot(run.steps[i]));
    result.steps.push_back(report_of(i, scan.time_s, links.sketch_from_robot()));
    result.steps.back().registered = registered;
    if (progress) {
      progress(i + 1);
    }
  }
  return result;
}

Localization filter_and_smooth(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                               const LocalizationParams& params,
                               const std::function<void(std::size_t)>& progress) {
  return task.smoothing == Smoothing::None
             ? filter_pass(sketch, run, task, params, progress)
             : localize_and_smooth(sketch, run, task, params, progress);
}

}  // namespace

void validate(const SmoothingPlan& plan) {
  validate_part("keyframes", plan.keyframes);
  validate_part("spline", plan.spline);
  validate_part("smoothing", plan.smoothing);
  validate_part("place_pairs", plan.place_pairs);
  validate_part("lag", plan.lag);
  require_in_range("max_modes", plan.max_modes, 1, 16);
}

void validate(const LocalizationParams& params) {
  validate_part("localizer", params.localizer);
  validate_part("odometry", params.odometry);
  validate_part("predictor", params.predictor);
  require_at_least("chain_way_m", params.chain_way_m, 0.0);
  validate_part("smoothing", params.smoothing);
}

Localization localize(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                      const LocalizationParams& params,
                      const std::function<void(std::size_t)>& progress) {
  validate(params);
  if (run.steps.empty()) {
    Localization nothing;
    nothing.status = Localization::Status::EmptyRun;
    return nothing;
  }
  switch (task.method) {
    case Method::Odometry:
      return reckon(run, task, params, progress);
    case Method::Chained:
      return chain(sketch, run, task, params, progress);
    case Method::Mcl:
      return filter_and_smooth(sketch, run, task, params, progress);
  }
  return {};
}

std::size_t steps_of_work(const Run& run, const LocalizationTask& task) {
  return (task.smoothing == Smoothing::None ? 1 : 2) * run.steps.size();
}

std::optional<double> guess_px_per_m(const Sketch& sketch, const Eigen::Vector2d& place_in_sketch,
                                     double heading_rad, const Scan& scan) {
  const RayCaster caster(sketch.occupied);
  const float diagonal_px =
      std::hypot(static_cast<float>(sketch.width_px()), static_cast<float>(sketch.height_px()));
  std::vector<double> ratios;
  for (const Eigen::Vector2d& point_in_robot : end_points_in_robot(scan)) {
    const double bearing_rad = std::atan2(point_in_robot.y(), point_in_robot.x());
    const float range_px =
        caster.range(place_in_sketch, static_cast<float>(heading_rad + bearing_rad), diagonal_px);
    if (range_px > 0.0F && range_px < diagonal_px && point_in_robot.norm() > 0.0) {
      ratios.push_back(range_px / point_in_robot.norm());
    }
  }
  return ratios.empty() ? std::nullopt : std::optional(quantile(ratios, 0.5));
}

}  // namespace sketchloc

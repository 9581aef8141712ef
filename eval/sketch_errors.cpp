#include "eval/sketch_errors.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

const ReferencePose* find_step(const Reference& reference, std::size_t step) {
  const auto it = std::ranges::lower_bound(reference.poses, step, {}, &ReferencePose::step);
  return it != reference.poses.end() && it->step == step ? &*it : nullptr;
}

double distance_px(const Sim2& a, const Sim2& b) {
  return (a.translation() - b.translation()).norm();
}

double distance_m(const Sim2& estimate, const ReferencePose& pose) {
  return distance_px(estimate, pose.sketch_from_robot) / pose.sketch_from_robot.scale();
}

/// The pose of the reference or its alternatives that is nearest to the estimate.
const ReferencePose& nearest_accepted(const Sim2& estimate, const ReferencePose& first,
                                      std::span<const Reference> alternatives) {
  const ReferencePose* nearest = &first;
  for (const Reference& alternative : alternatives) {
    const ReferencePose* pose = find_step(alternative, first.step);
    if (pose != nullptr && distance_m(estimate, *pose) < distance_m(estimate, *nearest)) {
      nearest = pose;
    }
  }
  return *nearest;
}

Eigen::Matrix2d position_covariance_px(const Estimate& estimate) {
  return estimate.covariance.topLeftCorner<2, 2>();
}

std::optional<double> position_nees(const Estimate& estimate, const ReferencePose& accepted) {
  const Eigen::Vector2d error_px =
      estimate.sketch_from_robot.translation() - accepted.sketch_from_robot.translation();
  const double reference_sigma_px = accepted.uncertainty_m * accepted.sketch_from_robot.scale();
  const Eigen::Matrix2d covariance_px =
      position_covariance_px(estimate) +
      reference_sigma_px * reference_sigma_px * Eigen::Matrix2d::Identity();
  return nees(error_px, covariance_px);
}

StepError error_of(const StepReport& report, const ReferencePose& first,
                   const ReferencePose& accepted) {
  const Sim2& estimate = report.estimate.sketch_from_robot;
  const Sim2& reference = accepted.sketch_from_robot;
  return {.step = report.step,
          .time_s = report.time_s,
          .translation_px = distance_px(estimate, reference),
          .translation_m = distance_m(estimate, accepted),
          .heading_rad = std::abs(wrap_rad(estimate.yaw_rad() - first.sketch_from_robot.yaw_rad())),
          .scale_ratio = estimate.scale() / reference.scale(),
          .uncertainty_m = accepted.uncertainty_m,
          .stated_sigma_m = stated_position_sigma_m(report.estimate),
          .position_nees = position_nees(report.estimate, accepted),
          .localized_probability = report.localized_probability,
          .share_within_bounds = report.share_within_bounds,
          .contradiction = report.contradiction,
          .signs = report.signs};
}

/// Way along the reference up to each of its poses, by the mean local scale of both ends.
std::vector<double> driven_m(const Reference& reference) {
  std::vector<double> driven(reference.poses.size(), 0.0);
  for (std::size_t i = 1; i < driven.size(); ++i) {
    const Sim2& from = reference.poses[i - 1].sketch_from_robot;
    const Sim2& to = reference.poses[i].sketch_from_robot;
    driven[i] = driven[i - 1] + 2.0 * distance_px(from, to) / (from.scale() + to.scale());
  }
  return driven;
}

template <typename Field>
std::vector<double> collect(std::span<const StepError> errors, Field field) {
  std::vector<double> values;
  values.reserve(errors.size());
  std::ranges::transform(errors, std::back_inserter(values), field);
  return values;
}

std::vector<double> known_nees(std::span<const StepError> errors) {
  std::vector<double> values;
  for (const StepError& error : errors) {
    if (error.position_nees) {
      values.push_back(*error.position_nees);
    }
  }
  return values;
}

}  // namespace

void validate(const LossDefinition& loss) {
  require_above("bound_m", loss.bound_m, 0.0);
  require_at_least("lasting_m", loss.lasting_m, 0.0);
}

bool is_right(const StepError& error, const RightDefinition& right) {
  return error.translation_m <= right.bound_m && error.heading_rad <= right.bound_rad;
}

double stated_position_sigma_m(const Estimate& estimate) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(position_covariance_px(estimate),
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff())) /
         estimate.sketch_from_robot.scale();
}

std::vector<StepError> step_errors(std::span<const StepReport> steps, const Reference& reference,
                                   std::span<const Reference> alternatives) {
  const std::vector<double> driven = driven_m(reference);
  std::vector<StepError> errors;
  for (const StepReport& report : steps) {
    const ReferencePose* first = find_step(reference, report.step);
    if (first == nullptr || !first->scored) {
      continue;
    }
    const ReferencePose& accepted =
        nearest_accepted(report.estimate.sketch_from_robot, *first, alternatives);
    errors.push_back(error_of(report, *first, accepted));
    errors.back().driven_m = driven[static_cast<std::size_t>(first - reference.poses.data())];
  }
  return errors;
}

std::optional<StepError> first_loss(std::span<const StepError> errors, const LossDefinition& loss) {
  validate(loss);
  const StepError* beyond_since = nullptr;
  for (const StepError& error : errors) {
    if (error.translation_m <= loss.bound_m) {
      beyond_since = nullptr;
      continue;
    }
    if (beyond_since == nullptr) {
      beyond_since = &error;
    }
    if (error.driven_m - beyond_since->driven_m >= loss.lasting_m) {
      break;
    }
  }
  return beyond_since != nullptr ? std::optional(*beyond_since) : std::nullopt;
}

SketchErrors summarize_sketch_errors(std::span<const StepError> errors,
                                     const LossDefinition& loss) {
  SketchErrors summary;
  if (errors.empty()) {
    return summary;
  }
  const std::vector<double> translation_m = collect(errors, &StepError::translation_m);
  summary.scored = errors.size();
  summary.share_within_1_m = share_within(translation_m, 1.0);
  summary.share_within_2_m = share_within(translation_m, 2.0);
  const auto of_uncertainty = [](const StepError& e) {
    return e.translation_m - 2.0 * e.uncertainty_m;
  };
  const bool exact =
      std::ranges::all_of(errors, [](const StepError& e) { return e.uncertainty_m == 0.0; });
  if (!exact) {
    summary.share_within_uncertainty = share_within(collect(errors, of_uncertainty), 0.0);
  }
  summary.translation_px = summarize(collect(errors, &StepError::translation_px));
  summary.translation_m = summarize(translation_m);
  summary.heading_rad = summarize(collect(errors, &StepError::heading_rad));
  summary.median_scale_ratio = quantile(collect(errors, &StepError::scale_ratio), 0.5);
  if (const std::optional<StepError> loss_step = first_loss(errors, loss)) {
    summary.first_loss_s = loss_step->time_s - errors.front().time_s;
  }
  summary.lost_at_end = translation_m.back() > loss.bound_m;
  constexpr double kPositionDegrees = 2.0;
  summary.position_nees = summarize_nees(known_nees(errors), kPositionDegrees);
  const auto count = static_cast<double>(errors.size());
  for (const StepError& error : errors) {
    const double right = is_right(error) ? 1.0 : 0.0;
    const double off = error.localized_probability - right;
    summary.share_localized += right / count;
    summary.mean_localized_probability += error.localized_probability / count;
    summary.localized_brier += off * off / count;
  }
  return summary;
}

}  // namespace sketchloc

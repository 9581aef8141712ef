#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "datasets/reference.hpp"
#include "eval/nees.hpp"
#include "eval/summary.hpp"
#include "filter/step_report.hpp"

namespace sketchloc {

/// When a run counts as lost.
struct LossDefinition {
  double bound_m = 3.0;    ///< error beyond which the robot is elsewhere, local metres, > 0
  double lasting_m = 5.0;  ///< way driven beyond the bound that makes it a loss, >= 0
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const LossDefinition& loss);

/// 1-sigma of the estimated position along its worst direction, in metres by the estimated scale.
double stated_position_sigma_m(const Estimate& estimate);

/// How far off the estimate of one scored step is.
struct StepError {
  std::size_t step = 0;
  double time_s = 0.0;
  double driven_m = 0.0;  ///< along the reference since its first pose, local metres
  double translation_px = 0.0;
  double translation_m = 0.0;           ///< by the reference's local scale
  double heading_rad = 0.0;             ///< in [0, pi]
  double scale_ratio = 1.0;             ///< estimated / reference local scale
  double uncertainty_m = 0.0;           ///< 1-sigma of the reference itself; 0 if exact
  double stated_sigma_m = 0.0;          ///< see stated_position_sigma_m()
  std::optional<double> position_nees;  ///< 2 degrees of freedom; the reference's variance added
  double localized_probability = 1.0;   ///< these four as the step's report states them
  double share_within_bounds = 1.0;
  double contradiction = 0.0;
  std::optional<LocalizedSigns> signs = std::nullopt;
};

/// What a stated probability of being localized is about.
struct RightDefinition {
  double bound_m = 2.0;       ///< position error, local metres, > 0
  double bound_rad = 0.5236;  ///< and heading error, > 0
};

bool is_right(const StepError& error, const RightDefinition& right = {});

/// The error of every step that has an estimate and a scored reference pose. Where `alternatives`
/// hold a pose for the step too, the nearer position counts; the heading is always that of the
/// first reference.
std::vector<StepError> step_errors(std::span<const StepReport> steps, const Reference& reference,
                                   std::span<const Reference> alternatives = {});

/// The first step from which the error stays beyond the bound for at least the lasting way, or
/// until the last step. None: never lost.
std::optional<StepError> first_loss(std::span<const StepError> errors,
                                    const LossDefinition& loss = {});

/// What is published of one run in a drawing.
struct SketchErrors {
  std::size_t scored = 0;
  double share_within_1_m = 0.0;  ///< of the scored steps, in [0, 1]
  double share_within_2_m = 0.0;
  /// Error at most twice the reference's own sigma; none where the reference is exact.
  std::optional<double> share_within_uncertainty;
  std::optional<ErrorSummary> translation_px;
  std::optional<ErrorSummary> translation_m;
  std::optional<ErrorSummary> heading_rad;
  double median_scale_ratio = 1.0;
  std::optional<double> first_loss_s;  ///< after the first scored step; none: never lost
  bool lost_at_end = false;            ///< the last scored step is beyond the bound; then
                                       ///< first_loss_s has a value
  std::optional<NeesSummary> position_nees;
  double share_localized = 0.0;             ///< steps that are right, in [0, 1]
  double mean_localized_probability = 0.0;  ///< as stated
  double localized_brier = 0.0;             ///< mean squared error of the stated probability
};

SketchErrors summarize_sketch_errors(std::span<const StepError> errors,
                                     const LossDefinition& loss = {});

}  // namespace sketchloc

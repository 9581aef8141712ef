#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "eval/localization.hpp"

namespace sketchloc {

/// What a filter believes at a step: its heaviest modes, each as probable as the filter says that
/// it is localized, by its weight.
std::vector<PoseHypothesis> believed_by(const StepReport& report, int max_modes);

/// A filter of the same kind that goes back. The predictor must outlive it.
StepBack filter_back(const Sketch& sketch, const LocalizerParams& params, WarpPredictor& predictor,
                     int max_modes);

/// Steps a filter through the run and smooths its poses with a lag (docs/smoothing.md): each pose
/// is what would have been known of it smoothing.lag.lag_m later. The end of the run is not waited
/// for.
Localization localize_with_lag(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                               const LocalizationParams& params,
                               const std::function<void(std::size_t)>& progress);

}  // namespace sketchloc

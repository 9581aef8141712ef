#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "eval/localization.hpp"
#include "smoothing/lag_smoother.hpp"

namespace sketchloc {

/// What a filter believes at a step: its heaviest modes, each as probable as the filter says that
/// it is localized, by its weight.
std::vector<PoseHypothesis> believed_by(const StepReport& report, int max_modes);

/// A filter of the same kind that goes back. The predictor must outlive it.
StepBack filter_back(const Sketch& sketch, const LocalizerParams& params, WarpPredictor& predictor,
                     int max_modes);

/// The report of a step with a smoothed pose in the place of the filter's own.
StepReport smoothed_report(StepReport report, const SmoothedPose& pose);

/// Steps a filter through the run, and smooths it as the task asks for (docs/smoothing.md): each
/// pose as it would have been known smoothing.lag.lag_m later, where the end of the run is not
/// waited for, or all of them with all that the run showed. The steps of the result are smoothed,
/// except, with all that it showed, where nothing could be registered.
Localization localize_and_smooth(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                                 const LocalizationParams& params,
                                 const std::function<void(std::size_t)>& progress);

}  // namespace sketchloc

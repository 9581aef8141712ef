#pragma once

#include <cstddef>
#include <functional>

#include "eval/localization.hpp"

namespace sketchloc {

/// The report of a step with a smoothed pose in the place of the filter's own.
StepReport smoothed_report(StepReport report, const SmoothedPose& pose);

/// Steps a filter through the run and another one back through it, from where the first one ended;
/// registers at keyframes from both filters' modes, and smooths what that says (docs/smoothing.md).
/// The steps of the result are smoothed, except where nothing could be registered.
Localization localize_and_smooth(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                                 const LocalizationParams& params,
                                 const std::function<void(std::size_t)>& progress);

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <functional>

#include "eval/localization.hpp"

namespace sketchloc {

/// Steps a filter through a run, from the task's start or from anywhere. The run has steps.
Localization filter_pass(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                         const LocalizationParams& params,
                         const std::function<void(std::size_t)>& progress);

/// A filter's way through a run, and what smoothing goes on with.
struct RefinedPass {
  Run run;                ///< with the odometry that the task asked for in the place of the wheels'
  LocalizationTask task;  ///< the same on that run
  Localization result;
};

/// The same as filter_pass(), for a run that is smoothed too: the task has a predictor.
RefinedPass refined_filter_pass(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                                const LocalizationParams& params,
                                const std::function<void(std::size_t)>& progress);

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <functional>

#include "eval/localization.hpp"

namespace sketchloc {

/// Steps a filter through a run, from the task's start or from anywhere. The run has steps.
Localization filter_pass(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                         const LocalizationParams& params,
                         const std::function<void(std::size_t)>& progress);

/// The run with the odometry that the task asks for in the place of the wheels' own.
Run with_odometry(const Run& run, const LocalizationTask& task,
                  const MatchedOdometryParams& params);

}  // namespace sketchloc

#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "apps/smooth_command.hpp"
#include "smoothing/drawing_spline.hpp"

namespace sketchloc {

/// Smooths the keyframes in the folder of a run and writes where the robot was at each. Throws
/// std::runtime_error where the folder has none, or none with a registration.
void smooth_run(const SmoothOptions& options, const SmoothParams& params);

/// fit_drawing_spline; where it finds none, a warning says so and names the run.
std::optional<DrawingSpline> spline_or_warning(const KeyframeRun& run,
                                               std::span<const SmoothedPose> smoothed,
                                               const DrawingSplineParams& params,
                                               const std::filesystem::path& of_run);

}  // namespace sketchloc

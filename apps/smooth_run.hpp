#pragma once

#include "apps/smooth_command.hpp"

namespace sketchloc {

/// Smooths the keyframes in the folder of a run and writes where the robot was at each. Throws
/// std::runtime_error where the folder has none, or none with a registration.
void smooth_run(const SmoothOptions& options, const SmoothParams& params);

}  // namespace sketchloc

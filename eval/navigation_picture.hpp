#pragma once

#include <string>

#include "eval/navigation.hpp"

namespace sketchloc {

/// The drawing with what the robot believed, and the building with where it was, as PNG bytes.
std::string picture_png(const NavigationTask& task, const NavigationTrial& trial);

}  // namespace sketchloc

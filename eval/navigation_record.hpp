#pragma once

#include <string>

#include "eval/navigation.hpp"

namespace sketchloc {

/// A trial as JSON, and back without its frames. Throws std::runtime_error where the text is none.
std::string navigation_json(const NavigationTrial& trial);
NavigationTrial navigation_from_json(const std::string& text);

}  // namespace sketchloc

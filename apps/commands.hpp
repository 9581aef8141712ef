#pragma once

#include <array>

#include "apps/program.hpp"

namespace sketchloc {

// One per <name>_command.cpp, in the order of --help.

inline constexpr std::array<AddCommand, 0> kCommands = {};

}  // namespace sketchloc

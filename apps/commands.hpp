#pragma once

#include <array>

#include "apps/generate_command.hpp"
#include "apps/program.hpp"

namespace sketchloc {

// One per <name>_command.cpp, in the order of --help.

inline constexpr std::array<AddCommand, 1> kCommands = {add_generate_command};

}  // namespace sketchloc

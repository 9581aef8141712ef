#pragma once

#include <array>

#include "apps/ablate_command.hpp"
#include "apps/convert_command.hpp"
#include "apps/demo_command.hpp"
#include "apps/evaluate_command.hpp"
#include "apps/generate_command.hpp"
#include "apps/localize_command.hpp"
#include "apps/navigate_command.hpp"
#include "apps/plan_command.hpp"
#include "apps/program.hpp"
#include "apps/register_command.hpp"
#include "apps/smooth_command.hpp"
#include "apps/topology_command.hpp"
#include "apps/track_command.hpp"
#include "apps/train_command.hpp"

namespace sketchloc {

// One per <name>_command.cpp, in the order of --help.

inline constexpr auto kCommands = std::to_array<AddCommand>(
    {add_demo_command, add_localize_command, add_track_command, add_register_command,
     add_smooth_command, add_topology_command, add_plan_command, add_navigate_command,
     add_ablate_command, add_evaluate_command, add_generate_command, add_convert_command,
     add_train_command});

}  // namespace sketchloc

#pragma once

#include "planning/free_space.hpp"

namespace sketchloc::detail {

/// What the way to a goal costs from every px, in steps to eight neighbours; infinite where there
/// is none [Dijkstra59].
Grid<float> price_to_go_m(const FreeSpace& space, const Eigen::Vector2d& goal_in_sketch);

}  // namespace sketchloc::detail

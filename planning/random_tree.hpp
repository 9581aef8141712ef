#pragma once

#include <cstdint>
#include <optional>

#include "planning/path.hpp"

namespace sketchloc {

/// A way found by two trees that grow towards each other, RRT-Connect [Kuffner00] of OMPL: quick
/// where there is room, none where the trees do not meet within `most_nodes` tries. Says nothing
/// of whether there is a way. Checks that both ends are free.
std::optional<PathPoints> connect_trees(const FreeSpace& space,
                                        const Eigen::Vector2d& start_in_sketch,
                                        const Eigen::Vector2d& goal_in_sketch, int most_nodes,
                                        std::uint64_t seed);

}  // namespace sketchloc

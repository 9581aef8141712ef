#pragma once

#include <Eigen/Core>
#include <vector>

#include "datasets/scan.hpp"
#include "motion/random.hpp"
#include "motion/se2.hpp"

namespace sketchloc::testing {

/// A wall from one point to another.
struct Wall {
  Eigen::Vector2d from_in_world;
  Eigen::Vector2d to_in_world;
};
using World = std::vector<Wall>;

/// 9 m x 7 m around the origin with two blocks in it.
World furnished_room();

/// Two parallel walls, 2 m apart, along x; far longer than a scan reaches.
World endless_corridor();

/// No beams yet: one per degree, 180 deg from right to left, 20 m.
Scan half_turn_scan();

/// 181 beams from a pose, with Gaussian noise on the ranges; where no wall is, infinity.
Scan scan_from(const World& world, const Se2& world_from_robot, double noise_m, Rng& rng);

}  // namespace sketchloc::testing

#pragma once

#include "datasets/sim/deformation.hpp"
#include "datasets/sim/floor_plan.hpp"
#include "datasets/sim/person.hpp"
#include "motion/random.hpp"

namespace sketchloc::detail {

/// A random distortion of a building, world (m) to a drawing (px) that lies anywhere: rooms and
/// corridors in the wrong size, rows of rooms sheared against each other, everything bent, turned
/// and out of proportion. Never folds inside the building.
Deformation distort(const FloorPlan& plan, const DistortionParams& params, Rng& rng);

}  // namespace sketchloc::detail

#pragma once

#include <span>
#include <vector>

#include "datasets/sim/detail/polyline.hpp"
#include "datasets/sim/floor_plan.hpp"
#include "datasets/sim/person.hpp"
#include "motion/random.hpp"

namespace sketchloc::detail {

/// Points that the pen visits without being lifted.
using Stroke = Polyline;

/// Joins walls that meet: always where they go straight on, round a corner with a given chance.
std::vector<Stroke> chain_walls(std::span<const Wall> walls, double one_go_share, Rng& rng);

/// What a person draws of a plan, in world coordinates: walls with their doors as gaps, some left
/// out, some as outlines, racks and a little of the furniture.
std::vector<Stroke> choose_strokes(const FloorPlan& plan, const PenParams& pen, Rng& rng);

/// The same stroke as a hand draws it, in px: rounded, wobbling, ending early or late.
Stroke drawn_by_hand(const Stroke& stroke_in_sketch, const PenParams& pen, Rng& rng);

}  // namespace sketchloc::detail

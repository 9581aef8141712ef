#pragma once

#include "datasets/sim/floor_plan.hpp"
#include "motion/random.hpp"

namespace sketchloc {

enum class BuildingKind { Home, Office, Warehouse };

/// Rooms of a flat or small house, some along a corridor, 55 to 160 m^2.
FloorPlan make_home(Rng& rng);

/// Corridors with rooms on both sides: one straight corridor, or a ring around a core (a loop),
/// the core sometimes cut by cross corridors; 20 to 45 m long.
FloorPlan make_office(Rng& rng);

/// A hall of rack rows with look-alike aisles and cross aisles, small offices along one side;
/// 30 to 55 m long.
FloorPlan make_warehouse(Rng& rng);

FloorPlan make_plan(BuildingKind kind, Rng& rng);

}  // namespace sketchloc

#pragma once

#include <functional>
#include <vector>

#include "datasets/sim/floor_plan.hpp"
#include "motion/random.hpp"

namespace sketchloc::detail {

/// What stands between two rooms.
enum class Passage { Wall, Door, Open };

/// Decides for two rooms that share an edge long enough for a door.
using PassageRule = std::function<Passage(const Room& first, const Room& second)>;

struct WallStyle {
  double inner_thickness_m = 0.12;
  double outer_thickness_m = 0.24;
  double door_width_m = 0.95;
  double glass_share = 0.0;  ///< of the inner walls, in [0, 1]
};

/// Walls and doors for rooms that tile a building: the rule's doors, and as many more (through
/// walls, between any two rooms that share an edge) as it takes to reach every room from the first.
/// Rooms that cannot be reached at all stay closed.
FloorPlan plan_from_rooms(std::vector<Room> rooms, const PassageRule& rule, const WallStyle& style,
                          Rng& rng);

/// Cuts a box into rooms by random straight walls, until no room is larger than max_area_m2.
std::vector<Room> subdivide(const PlaneBox& box, double min_side_m, double max_area_m2, Rng& rng);

/// Cuts [low, high] into pieces of random length in [min, max] (the ends are met exactly).
std::vector<double> random_cuts(double low, double high, double min_length, double max_length,
                                Rng& rng);

/// Puts desks, cabinets and tables into the rooms, clear of the doors.
void furnish(FloorPlan& plan, double items_per_m2, Rng& rng);

}  // namespace sketchloc::detail

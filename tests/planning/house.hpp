#pragma once

#include <utility>

#include "datasets/sketch.hpp"

namespace sketchloc::testing {

inline Sketch sketch_of(Grid<std::uint8_t> occupied) {
  Sketch sketch;
  sketch.occupied = std::move(occupied);
  return sketch;
}

/// 120 x 80 px: two rooms side by side with a wall of one px between them at x = 60, and a door in
/// it from y = 30 to `door_end` (30: no door). At 10 px per m the door of 20 px is 2 m wide.
inline Sketch house(int door_end = 50) {
  Grid<std::uint8_t> occupied(120, 80);
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 120; ++column) {
      const bool edge = row < 2 || row >= 78 || column < 2 || column >= 118;
      const bool wall = column == 60 && (row < 30 || row >= door_end);
      occupied.at({column, row}) = edge || wall ? 1 : 0;
    }
  }
  return sketch_of(std::move(occupied));
}

}  // namespace sketchloc::testing

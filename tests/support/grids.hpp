#pragma once

#include <cstdint>

#include "datasets/grid.hpp"

namespace sketchloc::testing {

/// Rooms of `room` x `room` cells with walls of one cell, a door of `door` cells in the middle of
/// each wall, and two pieces of furniture per room: what a LIDAR sees of a building.
Grid<std::uint8_t> rooms(int width, int height, int room, int door);

/// Thin strokes in all directions (straight, one cell wide, connected over corners only, as a
/// pencil line comes out of a scanner); the same seed gives the same grid.
Grid<std::uint8_t> thin_strokes(int width, int height, int strokes, std::uint64_t seed);

}  // namespace sketchloc::testing

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "registration/plane_map.hpp"

namespace sketchloc {

/// A straight piece of wall between two points of the world, without its doors.
struct Wall {
  Eigen::Vector2d from_in_world = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_in_world = Eigen::Vector2d::Zero();
  double thickness_m = 0.12;
  bool glass = false;  ///< the LIDAR sees through it most of the time

  double length_m() const { return (to_in_world - from_in_world).norm(); }
};

/// The gap that a door leaves in a wall, jamb to jamb.
struct Door {
  Eigen::Vector2d from_in_world = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_in_world = Eigen::Vector2d::Zero();

  Eigen::Vector2d centre_in_world() const { return 0.5 * (from_in_world + to_in_world); }
};

/// A rectangle of floor with one use, between the middles of its walls.
struct Room {
  enum class Use { Room, Corridor, Hall };
  Use use = Use::Room;
  PlaneBox box_in_world;
};

/// A rectangular thing on the floor.
struct Furniture {
  Eigen::Vector2d centre_in_world = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_size_m = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
  bool structural = false;  ///< a rack or a pillar: part of the building for the one who draws it

  /// Counter-clockwise.
  std::vector<Eigen::Vector2d> corners_in_world() const;
};

/// A building as lines: what an architect would draw. Frame: world, m.
struct FloorPlan {
  std::vector<Room> rooms{};
  std::vector<Wall> walls{};
  std::vector<Door> doors{};
  std::vector<Furniture> furniture{};
};

/// The smallest box that holds all rooms and walls; checks that there are any.
PlaneBox bounds_in_world(const FloorPlan& plan);

/// Where two rooms meet along more than a corner, or one room meets the outside.
struct RoomEdge {
  static constexpr std::size_t kOutside = static_cast<std::size_t>(-1);
  std::size_t first = 0;
  std::size_t second = kOutside;
  Eigen::Vector2d from_in_world = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_in_world = Eigen::Vector2d::Zero();

  bool outer() const { return second == kOutside; }
  double length_m() const { return (to_in_world - from_in_world).norm(); }
};

/// All edges of rooms that do not overlap; each stretch of wall appears once.
std::vector<RoomEdge> find_edges(std::span<const Room> rooms);

}  // namespace sketchloc

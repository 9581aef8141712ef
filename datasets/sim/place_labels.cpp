#include "datasets/sim/place_labels.hpp"

#include <algorithm>
#include <limits>

namespace sketchloc {
namespace {

constexpr double kWay_m = 4.5;  ///< wider than the widest cross aisle that is built

bool is_rack(const Furniture& thing) { return thing.structural && thing.yaw_rad == 0.0; }

PlaneBox box_of(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return {from.cwiseMin(to), from.cwiseMax(to)};
}

/// What is met first along an axis (0 = x, 1 = y) in one direction (-1, 1).
struct Sight {
  double clear_m = std::numeric_limits<double>::infinity();
  bool rack = false;
  int long_axis = 0;  ///< of the rack

  bool is_way() const { return clear_m > kWay_m; }
  bool is_rack_along(int axis) const { return !is_way() && rack && long_axis == axis; }
};

/// How far it is to a box along an axis; negative where it lies behind or beside.
double clear_to(const PlaneBox& box, const Eigen::Vector2d& point, int axis, int direction) {
  const int across = 1 - axis;
  if (point(across) < box.low(across) || point(across) > box.high(across)) {
    return -1.0;
  }
  return direction > 0 ? box.low(axis) - point(axis) : point(axis) - box.high(axis);
}

}  // namespace

PlaceLabeller::PlaceLabeller(const FloorPlan& plan) {
  for (const Wall& wall : plan.walls) {
    obstacles_.push_back({box_of(wall.from_in_world, wall.to_in_world)});
  }
  for (const Door& door : plan.doors) {
    obstacles_.push_back({box_of(door.from_in_world, door.to_in_world)});
  }
  for (const Furniture& thing : plan.furniture) {
    if (is_rack(thing)) {
      const PlaneBox box = {thing.centre_in_world - thing.half_size_m,
                            thing.centre_in_world + thing.half_size_m};
      obstacles_.push_back({box, true});
    }
  }
  for (const Room& room : plan.rooms) {
    if (room.use != Room::Use::Room) {
      open_.push_back(room.box_in_world);
    }
  }
}

PlaceLabel PlaceLabeller::label_at(const Eigen::Vector2d& point_in_world) const {
  if (std::ranges::none_of(open_,
                           [&](const PlaneBox& box) { return box.contains(point_in_world); })) {
    return PlaceLabel::Corridor;
  }
  const auto sight = [&](int axis, int direction) {
    Sight nearest;
    for (const Obstacle& obstacle : obstacles_) {
      const double clear_m = clear_to(obstacle.box_in_world, point_in_world, axis, direction);
      if (clear_m >= 0.0 && clear_m < nearest.clear_m) {
        const Eigen::Vector2d size = obstacle.box_in_world.size();
        nearest = {clear_m, obstacle.rack, size.x() >= size.y() ? 0 : 1};
      }
    }
    return nearest;
  };
  int ways = 0;
  bool along_rack = false;
  for (const int axis : {0, 1}) {
    const Sight back = sight(axis, -1);
    const Sight ahead = sight(axis, 1);
    ways += (back.is_way() ? 1 : 0) + (ahead.is_way() ? 1 : 0);
    along_rack |= back.is_rack_along(1 - axis) || ahead.is_rack_along(1 - axis);
  }
  if (ways >= 3) {
    return PlaceLabel::Intersection;
  }
  return along_rack ? PlaceLabel::Rackspace : PlaceLabel::Corridor;
}

std::vector<PlaceLabel> PlaceLabeller::labels(const MetricTrajectory& world_from_robot) const {
  std::vector<PlaceLabel> labels;
  labels.reserve(world_from_robot.size());
  for (const Stamped<Se2>& pose : world_from_robot) {
    labels.push_back(label_at(pose.pose.translation()));
  }
  return labels;
}

bool has_racks(const FloorPlan& plan) { return std::ranges::any_of(plan.furniture, is_rack); }

}  // namespace sketchloc

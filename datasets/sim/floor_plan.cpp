#include "datasets/sim/floor_plan.hpp"

#include <algorithm>
#include <cmath>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kSamePlace_m = 1e-6;
constexpr double kShortestEdge_m = 0.05;

/// Interval along a wall line.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// One side of a box: the line `across = level`, from low to high along the other axis.
struct Side {
  int along_axis = 0;
  double level = 0.0;
  Interval extent;
};

Side side_of(const PlaneBox& box, int side) {
  const int across_axis = side / 2;
  const int along_axis = 1 - across_axis;
  return {.along_axis = along_axis,
          .level = side % 2 == 0 ? box.low(across_axis) : box.high(across_axis),
          .extent = {box.low(along_axis), box.high(along_axis)}};
}

Eigen::Vector2d point_on(const Side& side, double along) {
  Eigen::Vector2d point;
  point(side.along_axis) = along;
  point(1 - side.along_axis) = side.level;
  return point;
}

RoomEdge edge_on(const Side& side, const Interval& part, std::size_t first, std::size_t second) {
  return {.first = first,
          .second = second,
          .from_in_world = point_on(side, part.low),
          .to_in_world = point_on(side, part.high)};
}

/// What is left of an interval without others.
std::vector<Interval> without(const Interval& whole, std::vector<Interval> taken) {
  std::sort(taken.begin(), taken.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::vector<Interval> left;
  double reached = whole.low;
  for (const Interval& interval : taken) {
    if (interval.low - reached > kShortestEdge_m) {
      left.push_back({reached, interval.low});
    }
    reached = std::max(reached, interval.high);
  }
  if (whole.high - reached > kShortestEdge_m) {
    left.push_back({reached, whole.high});
  }
  return left;
}

/// The edges on one side of one room; shared ones only from the room with the lower index.
void append_edges_of_side(std::span<const Room> rooms, std::size_t index, int side_index,
                          std::vector<RoomEdge>& edges) {
  const Side side = side_of(rooms[index].box_in_world, side_index);
  std::vector<Interval> taken;
  for (std::size_t other = 0; other < rooms.size(); ++other) {
    const Side facing = side_of(rooms[other].box_in_world, side_index ^ 1);
    const Interval common = {std::max(side.extent.low, facing.extent.low),
                             std::min(side.extent.high, facing.extent.high)};
    if (other == index || std::abs(facing.level - side.level) > kSamePlace_m ||
        common.high - common.low < kShortestEdge_m) {
      continue;
    }
    taken.push_back(common);
    if (index < other) {
      edges.push_back(edge_on(side, common, index, other));
    }
  }
  for (const Interval& part : without(side.extent, std::move(taken))) {
    edges.push_back(edge_on(side, part, index, RoomEdge::kOutside));
  }
}

}  // namespace

std::vector<Eigen::Vector2d> Furniture::corners_in_world() const {
  const Eigen::Vector2d forward =
      half_size_m.x() * Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad));
  const Eigen::Vector2d left =
      half_size_m.y() * Eigen::Vector2d(-std::sin(yaw_rad), std::cos(yaw_rad));
  return {centre_in_world - forward - left, centre_in_world + forward - left,
          centre_in_world + forward + left, centre_in_world - forward + left};
}

PlaneBox bounds_in_world(const FloorPlan& plan) {
  check(!plan.rooms.empty() || !plan.walls.empty(), "a floor plan has rooms or walls");
  PlaneBox bounds = plan.rooms.empty()
                        ? PlaneBox{plan.walls[0].from_in_world, plan.walls[0].from_in_world}
                        : plan.rooms[0].box_in_world;
  const auto include = [&bounds](const Eigen::Vector2d& point) {
    bounds.low = bounds.low.cwiseMin(point);
    bounds.high = bounds.high.cwiseMax(point);
  };
  for (const Room& room : plan.rooms) {
    include(room.box_in_world.low);
    include(room.box_in_world.high);
  }
  for (const Wall& wall : plan.walls) {
    include(wall.from_in_world);
    include(wall.to_in_world);
  }
  return bounds;
}

std::vector<RoomEdge> find_edges(std::span<const Room> rooms) {
  std::vector<RoomEdge> edges;
  for (std::size_t index = 0; index < rooms.size(); ++index) {
    for (int side = 0; side < 4; ++side) {
      append_edges_of_side(rooms, index, side, edges);
    }
  }
  return edges;
}

}  // namespace sketchloc

#include "planning/follower.hpp"

#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"
#include "planning/grid_search.hpp"

namespace sketchloc {
namespace {

constexpr double kArrived_m = 0.04;
constexpr double kEscape_m = 0.15;  ///< so far a robot that stands too near to something may move

/// The place so far along a way; its end where it is shorter.
Eigen::Vector2d place_along(const PathPoints& path, double way_m) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double side_m = (path[i] - path[i - 1]).norm();
    if (side_m >= way_m && side_m > 0.0) {
      return path[i - 1] + (path[i] - path[i - 1]) * (way_m / side_m);
    }
    way_m -= side_m;
  }
  return path.back();
}

double length_of(const PathPoints& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += (path[i] - path[i - 1]).norm();
  }
  return length;
}

NextStep step_towards(const Eigen::Vector2d& place_in_robot_m, const FollowerParams& params) {
  const double bearing_rad = std::atan2(place_in_robot_m.y(), place_in_robot_m.x());
  const double turn_rad = std::clamp(bearing_rad, -params.turn_rad, params.turn_rad);
  const double step_m = std::abs(bearing_rad) <= params.straight_rad
                            ? std::min(place_in_robot_m.norm(), params.step_m)
                            : 0.0;
  return {
      .status = NextStep::Status::Drives,
      .robot_from_next = Se2::from_xy_yaw(0.0, 0.0, turn_rad) * Se2::from_xy_yaw(step_m, 0.0, 0.0)};
}

/// The way around what was seen to a place or a free one beside it, in cells; none: there is none.
std::optional<PathPoints> way_to(const Eigen::Vector2d& place, const Eigen::Vector2d& robot,
                                 const FreeSpace& space, double may_move_px) {
  const std::optional<Eigen::Vector2d> free = space.nearest_free(place);
  if (!free || (*free - place).norm() > may_move_px) {
    return std::nullopt;
  }
  const GridSearch searched = search_grid(space, robot, *free);
  return searched.status == GridSearch::Status::Found
             ? std::optional(pulled_straight(corners_of(searched.path_in_sketch), space))
             : std::nullopt;
}

}  // namespace

void validate(const FollowerParams& params) {
  require_above("step_m", params.step_m, 0.0);
  require_above("turn_rad", params.turn_rad, 0.0);
  require_above("straight_rad", params.straight_rad, 0.0);
  require_above("look_ahead_m", params.look_ahead_m, 0.0);
  validate_part("body", params.body);
}

NextStep next_step(const PathPoints& path_in_robot_m, const NearbyObstacles& obstacles,
                   const Se2& odom_from_robot, const FollowerParams& params) {
  NextStep none;
  NextStep arrived;
  arrived.status = NextStep::Status::Arrived;
  if (path_in_robot_m.empty()) {
    return none;
  }
  const double length_m = length_of(path_in_robot_m);
  if (length_m <= kArrived_m) {
    return arrived;
  }
  const Sketch window = obstacles.around(odom_from_robot);
  const FreeSpace space(window, ScaleField(*window.px_per_m), params.body, Objective::Balanced);
  const Eigen::Vector2d robot = obstacles.cells_from_robot(Eigen::Vector2d::Zero());
  const std::optional<Eigen::Vector2d> start = space.nearest_free(robot);
  if (!start || space.length_m(robot, *start) > kEscape_m) {
    return none;
  }
  if (*start != robot) {
    return step_towards(obstacles.robot_from_cells(*start), params);
  }
  for (double ahead_m = params.look_ahead_m; ahead_m > 0.3; ahead_m *= 0.6) {
    const bool is_end = ahead_m >= length_m;
    const Eigen::Vector2d place = obstacles.cells_from_robot(place_along(path_in_robot_m, ahead_m));
    const double may_move_px = (is_end ? 0.1 : 0.4 * ahead_m) * *window.px_per_m;
    if (const auto way = way_to(place, robot, space, may_move_px)) {
      const Eigen::Vector2d next = way->size() > 2 ? obstacles.robot_from_cells((*way)[1])
                                                   : obstacles.robot_from_cells(way->back());
      return next.norm() <= kArrived_m ? arrived : step_towards(next, params);
    }
  }
  return none;
}

}  // namespace sketchloc

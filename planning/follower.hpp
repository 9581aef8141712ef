#pragma once

#include <Eigen/Core>
#include <optional>

#include "motion/se2.hpp"
#include "planning/free_space.hpp"
#include "planning/nearby_obstacles.hpp"
#include "planning/path.hpp"

namespace sketchloc {

struct FollowerParams {
  double step_m = 0.2;         ///< driven in one go at most, > 0
  double turn_rad = 0.5;       ///< turned in one go at most, > 0
  double straight_rad = 0.35;  ///< what lies ahead by less is driven to, > 0
  double look_ahead_m = 2.5;   ///< along the way, to the place that is headed for, > 0
  BodyParams body{.radius_m = 0.22, .pose_sigma_m = 0.04, .log_scale_sigma = 0.0};
};

template <typename Visitor>
void visit_fields(FollowerParams& params, Visitor&& visit) {
  visit("step_m", params.step_m);
  visit("turn_rad", params.turn_rad);
  visit("straight_rad", params.straight_rad);
  visit("look_ahead_m", params.look_ahead_m);
  visit("body", params.body);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const FollowerParams& params);

/// What a robot does next.
struct NextStep {
  enum class Status {
    Drives,
    Arrived,  ///< the way's end is where the robot stands
    Blocked   ///< what the scans saw leaves no way to any place ahead
  };
  Status status = Status::Blocked;
  Se2 robot_from_next;  ///< a turn on the spot, then straight on
};

/// The next step along a way that is given in the robot's metres, around everything that the last
/// scans saw: to the farthest place of the way ahead that can be reached. Nothing is driven that
/// the scans do not leave free.
NextStep next_step(const PathPoints& path_in_robot_m, const NearbyObstacles& obstacles,
                   const Se2& odom_from_robot, const FollowerParams& params);

}  // namespace sketchloc

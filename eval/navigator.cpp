#include "eval/navigator.hpp"

#include <stdexcept>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const NavigationParams& params) {
  validate_part("planning", params.planning);
  if (params.planning.turning_radius_m > 0.0) {
    throw std::invalid_argument(
        "planning.turning_radius_m: a drive turns on the spot and cannot keep to a radius; leave "
        "it 0, or plan with it by `sketchloc plan`");
  }
  validate_part("follower", params.follower);
  validate_part("nearby", params.nearby);
  validate_part("task", params.task);
  require_above("off_way_m", params.off_way_m, 0.0);
  require_above("replan_m", params.replan_m, 0.0);
  require_at_least("look_m", params.look_m, 0.0);
  require_in_range("lost_below", params.lost_below, 0.0, 1.0);
  require_at_least("most_looks", params.most_looks, 0.0);
  require_at_least("most_cycles", params.most_cycles, 1.0);
  require_at_least("goal_looks", params.goal_looks, 1.0);
  require_at_least("near_enough_m", params.near_enough_m, 0.0);
  require_above("straight_m", params.straight_m, 0.0);
  require_at_least("most_blocked", params.most_blocked, 1.0);
  require_above("arrived_m", params.arrived_m, 0.0);
  require_above("success_m", params.success_m, 0.0);
}

Navigator::Navigator(const NavigationTask& task, const NavigationParams& params,
                     RobotFinder& finder, std::uint64_t seed)
    : params_(params),
      finder_(finder),
      goal_in_sketch_(task.drawing.sketch_from_world(task.goal_in_world)),
      goal_(params.goal_looks),
      way_(task.drawing.sketch, goal_in_sketch_, params.planning),
      obstacles_(params.nearby),
      seed_(seed) {
  way_.add(finder.sketch_from_robot());
  way_.plan(seed_);
}

std::optional<Se2> Navigator::next(const RunStep& measured) {
  finder_.step(measured);
  finder_.look();  // the way is driven through the warp too: rooms have proportions of their own
  obstacles_.add(measured.scan, finder_.odom_from_robot());
  way_.add(finder_.sketch_from_robot());
  doing_ = Doing::Drives;
  if (finder_.localized_probability() < params_.lost_below && looks_++ < params_.most_looks) {
    doing_ = Doing::LooksAround;
    replans_ = true;
    return turn_on_the_spot();
  }
  find_goal();
  return goal_in_robot_.norm() <= params_.arrived_m ? end(Status::Arrived) : drive_on();
}

Se2 Navigator::turn_on_the_spot() const {
  return Se2::from_xy_yaw(0.0, 0.0, params_.follower.turn_rad);
}

std::optional<Se2> Navigator::end(Status status) {
  status_ = status;
  doing_ = status == Status::Arrived ? Doing::Arrives : Doing::GivesUp;
  return std::nullopt;
}

/// In the last metres by all looks together: better than through the pose of the filter.
void Navigator::find_goal() {
  goal_in_robot_ = finder_.robot_from_sketch(goal_in_sketch_);
  if (goal_in_robot_.norm() < params_.look_m) {
    const Se2& odom_from_robot = finder_.odom_from_robot();
    goal_.add(finder_.look_for(goal_in_sketch_), odom_from_robot);
    goal_in_robot_ = odom_from_robot.inverse() * goal_.goal_in_odom();
  }
}

NextStep Navigator::next_step_to_goal() {
  const bool is_near = goal_in_robot_.norm() < params_.straight_m;
  return next_step(
      is_near ? PathPoints{Eigen::Vector2d::Zero(), goal_in_robot_} : way_.rest_in_robot(finder_),
      obstacles_, finder_.odom_from_robot(), params_.follower);
}

std::optional<Se2> Navigator::drive_on() {
  if (replans_ || way_since_plan_m_ >= params_.replan_m || !way_.is_on_way(params_.off_way_m)) {
    way_.plan(++seed_);
    doing_ = Doing::Replans;
    replans_ = false;
    way_since_plan_m_ = 0.0;
  }
  const NextStep step = next_step_to_goal();
  if (step.status == NextStep::Status::Arrived) {
    return end(Status::Arrived);
  }
  if (step.status == NextStep::Status::Blocked) {
    return blocked();
  }
  const double step_m = step.robot_from_next.translation().norm();
  way_since_plan_m_ += step_m;
  if (step_m > 0.0) {
    blocked_ = 0;
    looks_ = finder_.localized_probability() >= params_.lost_below ? 0 : looks_;
  }
  return step.robot_from_next;
}

/// Nothing leads nearer: it is there, or looks around for another way.
std::optional<Se2> Navigator::blocked() {
  if (goal_in_robot_.norm() <= params_.near_enough_m) {
    return end(Status::Arrived);
  }
  doing_ = Doing::Blocked;
  replans_ = true;
  return ++blocked_ < params_.most_blocked ? std::optional(turn_on_the_spot()) : end(Status::Stuck);
}

}  // namespace sketchloc

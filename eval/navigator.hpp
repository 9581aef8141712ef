#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "eval/drawn_way.hpp"
#include "eval/goal_estimator.hpp"
#include "eval/navigation_task.hpp"
#include "eval/robot_finder.hpp"
#include "filter/localizer_params.hpp"
#include "planning/follower.hpp"
#include "planning/planner.hpp"

namespace sketchloc {

/// How a robot drives to a goal in a drawing.
struct NavigationParams {
  PlanParams planning{.move_ends_m = 1.5, .crossing_cost_m = 10.0, .improvements = 300};
  FollowerParams follower{
      .body = {.radius_m = 0.22,  // scans scatter: what was seen is wide as it is
               .pose_sigma_m = 0.0,
               .log_scale_sigma = 0.0}};
  NearbyParams nearby;
  NavigationTaskParams task;
  /// Of the start, which the robot is told exactly but for the proportions of the drawing there.
  StartSpread start{.position_m = 0.1, .heading_rad = 0.04, .log_scale = 0.05};
  double off_way_m = 0.25;  ///< this far from the way in the drawing it plans anew, > 0
  double replan_m = 2.5;    ///< or after so much way, by the scales found on it, > 0
  double look_m = 3.0;      ///< this near to the goal, looks at it are remembered, >= 0
  double straight_m = 1.5;  ///< this near to the goal it drives to it, not along the way, > 0
  double lost_below = 0.2;  ///< localized probability below which it stops and looks around, [0, 1]
  int most_looks = 12;      ///< turns on the spot for that, until it has driven again, >= 0
  int most_cycles = 500;    ///< scans until it gives up, >= 1
  int goal_looks = 8;       ///< that say together where the goal is, >= 1
  double near_enough_m = 0.3;  ///< where nothing leads nearer to the goal, it has arrived, >= 0
  int most_blocked = 25;       ///< cycles in a row without a way, >= 1
  double arrived_m = 0.06;     ///< it stops where it believes the goal to be this near, > 0
  double success_m = 0.2;      ///< from the true goal, > 0
};

template <typename Visitor>
void visit_fields(NavigationParams& params, Visitor&& visit) {
  visit("planning", params.planning);
  visit("follower", params.follower);
  visit("nearby", params.nearby);
  visit("task", params.task);
  visit("start", params.start);
  visit("off_way_m", params.off_way_m);
  visit("replan_m", params.replan_m);
  visit("look_m", params.look_m);
  visit("straight_m", params.straight_m);
  visit("lost_below", params.lost_below);
  visit("most_looks", params.most_looks);
  visit("most_cycles", params.most_cycles);
  visit("goal_looks", params.goal_looks);
  visit("near_enough_m", params.near_enough_m);
  visit("most_blocked", params.most_blocked);
  visit("arrived_m", params.arrived_m);
  visit("success_m", params.success_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const NavigationParams& params);

/// A drive to a goal in a drawing, scan by scan.
class Navigator {
 public:
  enum class Status {
    Drives,
    Arrived,  ///< so it believes
    Stuck     ///< no way left
  };

  /// What it does after a scan.
  enum class Doing {
    Drives,
    Replans,      ///< plans anew and drives on
    LooksAround,  ///< turns on the spot: it does not know where it is
    Blocked,      ///< turns on the spot: what was seen leaves no way
    Arrives,      ///< stops, as it believes at the goal
    GivesUp
  };

  /// Plans the first way. Task, parameters and finder must outlive the navigator.
  Navigator(const NavigationTask& task, const NavigationParams& params, RobotFinder& finder,
            std::uint64_t seed);

  /// What to do after a scan; none: the drive is over.
  std::optional<Se2> next(const RunStep& measured);

  Status status() const { return status_; }
  Doing doing() const { return doing_; }
  const NearbyObstacles& obstacles() const { return obstacles_; }
  const PathPoints& path_in_sketch() const { return way_.path_in_sketch(); }
  /// In the robot's metres, of the last scan.
  const Eigen::Vector2d& goal_in_robot() const { return goal_in_robot_; }

 private:
  Se2 turn_on_the_spot() const;
  void find_goal();
  std::optional<Se2> drive_on();
  NextStep next_step_to_goal();
  std::optional<Se2> blocked();
  std::optional<Se2> end(Status status);

  const NavigationParams& params_;
  RobotFinder& finder_;
  Eigen::Vector2d goal_in_sketch_;
  Eigen::Vector2d goal_in_robot_ = Eigen::Vector2d::Zero();
  GoalEstimator goal_;
  DrawnWay way_;
  NearbyObstacles obstacles_;
  std::uint64_t seed_;
  bool replans_ = false;
  double way_since_plan_m_ = 0.0;
  int blocked_ = 0;
  int looks_ = 0;
  Status status_ = Status::Drives;
  Doing doing_ = Doing::Drives;
};

}  // namespace sketchloc

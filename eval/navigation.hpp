#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "datasets/sim/data_set.hpp"
#include "eval/robot_finder.hpp"
#include "planning/follower.hpp"
#include "planning/planner.hpp"

namespace sketchloc {

/// How many drives a suite asks for; plans are by turns homes, offices and warehouses.
struct NavigationSuiteParams {
  int plans = 200;    ///< drawn as people draw, >= 0
  int tps_plans = 0;  ///< drawn under one spline, as in [Chen20], >= 0
};

template <typename Visitor>
void visit_fields(NavigationSuiteParams& params, Visitor&& visit) {
  visit("plans", params.plans);
  visit("tps_plans", params.tps_plans);
}

/// How a robot drives to a goal in a drawing.
struct NavigationParams {
  PlanParams planning{.move_ends_m = 1.5, .crossing_cost_m = 10.0, .improvements = 300};
  FollowerParams follower;
  NearbyParams nearby;
  double replan_m = 2.0;    ///< way after which it plans anew, > 0
  double look_m = 4.0;      ///< this near to the goal, scans are registered for it, >= 0
  double straight_m = 1.5;  ///< this near to the goal it drives to it, not along the way, > 0
  double lost_below = 0.2;  ///< localized probability below which it stops and looks around, [0, 1]
  int most_looks = 12;      ///< turns on the spot for that, until it has driven again, >= 0
  int most_cycles = 500;    ///< scans until it gives up, >= 1
  int goal_looks = 9;       ///< of which the middle one is believed, >= 1
  double near_enough_m = 0.3;  ///< where nothing leads nearer to the goal, it has arrived, >= 0
  int most_blocked = 25;       ///< cycles in a row without a way, >= 1
  double arrived_m = 0.06;     ///< it stops where it believes the goal to be this near, > 0
  double success_m = 0.2;      ///< from the true goal, > 0
  double least_way_m = 4.0;    ///< from start to goal, as the crow flies, > 0
  double most_way_m = 15.0;    ///< > least_way_m
};

template <typename Visitor>
void visit_fields(NavigationParams& params, Visitor&& visit) {
  visit("planning", params.planning);
  visit("follower", params.follower);
  visit("nearby", params.nearby);
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
  visit("least_way_m", params.least_way_m);
  visit("most_way_m", params.most_way_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const NavigationParams& params);

/// A robot in a simulated building that somebody drew, and where it is to go.
struct NavigationTask {
  std::string set;
  std::string kind;  ///< who drew
  Building building;
  Drawing drawing;
  LidarModel lidar;
  Se2 world_from_start;
  Eigen::Vector2d goal_in_world = Eigen::Vector2d::Zero();
  double shortest_m = 0.0;  ///< way in the true building
};

/// Kind `human` or `tps`. The goal is a place that a robot has been driven to.
NavigationTask navigation_task(const std::string& kind, int plan, const NavigationParams& params,
                               std::uint64_t seed);

/// The robot at one scan.
struct NavigationFrame {
  Se2 world_from_robot;
  Sim2 sketch_from_robot;  ///< as it believes
  double localized_probability = 1.0;
  bool collided = false;
};

/// One drive to one goal.
struct NavigationTrial {
  enum class End {
    Arrived,  ///< so it believed
    Stuck,    ///< no way left
    TooLong
  };
  std::string set;
  std::string kind;
  std::string method;
  End end = End::TooLong;
  double error_m = 0.0;    ///< from the goal where it ended
  double nearest_m = 0.0;  ///< to the goal on the way
  double way_m = 0.0;
  double shortest_m = 0.0;
  int collisions = 0;       ///< steps that the true building stopped
  int seen_collisions = 0;  ///< of them with something that the LIDAR had seen
  std::vector<double> cycle_ms = {};
  std::vector<NavigationFrame> frames = {};
  PathPoints first_path_in_sketch = {};

  bool success(double within_m) const { return end == End::Arrived && error_m <= within_m; }
};

/// Drives to the goal: scan, find the robot, plan, one step, until it believes to be there. `clock`
/// gives seconds.
NavigationTrial navigate(const NavigationTask& task, const LocalizationMethod& method,
                         const LocalizationParams& localization, const NavigationParams& params,
                         WarpPredictor* predictor, std::uint64_t seed,
                         const std::function<double()>& clock);

/// A trial as JSON, and back without its frames. Throws std::runtime_error where the text is none.
std::string navigation_json(const NavigationTrial& trial);
NavigationTrial navigation_from_json(const std::string& text);

/// The drawing with what the robot believed, and the building with where it was, as PNG bytes.
std::string picture_png(const NavigationTask& task, const NavigationTrial& trial);

/// Tables of many trials: `metrics.json`, for a document, and a page.
std::string navigation_suite_json(std::span<const NavigationTrial> trials, double success_m);
std::string navigation_suite_markdown(std::span<const NavigationTrial> trials, double success_m);
std::string navigation_suite_html(std::span<const NavigationTrial> trials, double success_m);

}  // namespace sketchloc

#include "eval/navigation.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <stdexcept>

#include "eval/simulated_drive.hpp"
#include "eval/summary.hpp"
#include "motion/validate.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSuite = 9000;  // buildings of no other suite
constexpr std::uint64_t kGoalStream = 9001;
constexpr std::uint64_t kWorldStream = 9002;
constexpr double kStepCheck_m = 0.02;
constexpr double kDense_m = 0.25;

/// The true robot among the true things.
class SimulatedRobot {
 public:
  SimulatedRobot(const NavigationTask& task, double radius_m, std::uint64_t seed)
      : map_(task.building.map),
        clearance_cells_(distance_field_px(map_.cells)),
        lidar_(map_, task.lidar),
        rng_(make_rng(seed, kWorldStream)),
        wheels_(OdometryModel{}, rng_),
        radius_m_(radius_m),
        world_from_robot_(task.world_from_start) {}

  RunStep measure(double time_s) {
    return {.scan = lidar_.scan(world_from_robot_, time_s, rng_),
            .odom_from_robot = odom_from_robot_};
  }

  /// Drives as far as nothing is in its way; false where something was. The wheels turn all the
  /// same: they measure what was driven.
  bool drive(const Se2& robot_from_next) {
    const Se2 turned = Se2::from_xy_yaw(0.0, 0.0, robot_from_next.yaw_rad());
    const double way_m = robot_from_next.translation().norm();
    double free_m = 0.0;
    const auto pose_at = [&](double m) {
      return world_from_robot_ * turned * Se2::from_xy_yaw(m, 0.0, 0.0);
    };
    while (free_m < way_m && fits(pose_at(std::min(free_m + kStepCheck_m, way_m)).translation())) {
      free_m = std::min(free_m + kStepCheck_m, way_m);
    }
    const Se2 driven = turned * Se2::from_xy_yaw(free_m, 0.0, 0.0);
    world_from_robot_ = world_from_robot_ * driven;
    odom_from_robot_ = odom_from_robot_ * wheels_.measured(driven, rng_);
    return free_m >= way_m;
  }

  const Se2& world_from_robot() const { return world_from_robot_; }

 private:
  bool fits(const Eigen::Vector2d& point_in_world) const {
    const std::optional<float> cells =
        sample(clearance_cells_, map_.cells_from_world(point_in_world));
    // to the edge of the nearest cell, but for rounding of the disc to cells
    return !cells || (static_cast<double>(*cells) - 0.5) * map_.cell_m >= radius_m_ - map_.cell_m;
  }

  const MetricMap& map_;
  Grid<float> clearance_cells_;
  LidarSimulator lidar_;
  Rng rng_;
  OdometrySimulator wheels_;
  double radius_m_;
  Se2 world_from_robot_;
  Se2 odom_from_robot_;
};

/// The drawing's scale as the robot found it on its way, and ways to the goal by that.
class DrawnWay {
 public:
  DrawnWay(const Sketch& sketch, const Eigen::Vector2d& goal_in_sketch, const PlanParams& params)
      : sketch_(sketch), goal_in_sketch_(goal_in_sketch), params_(params) {}

  void add(const Sim2& sketch_from_robot) {
    samples_.push_back({sketch_from_robot.translation(), sketch_from_robot.scale()});
  }

  void plan(std::uint64_t seed) {
    const Planner planner(sketch_, ScaleField(sketch_.width_px(), sketch_.height_px(), samples_),
                          params_);
    const Plan plan = planner.plan({.start_in_sketch = samples_.back().place_in_sketch,
                                    .goal_in_sketch = goal_in_sketch_,
                                    .last_path_in_sketch = path_},
                                   seed);
    path_ = plan.found() ? plan.path_in_sketch : PathPoints{};
    if (plan.found()) {
      path_.push_back(goal_in_sketch_);  // the planner may have moved it
    }
  }

  const PathPoints& path_in_sketch() const { return path_; }

  /// The rest of the way from the robot on, in its metres.
  PathPoints rest_in_robot(const RobotFinder& finder) const {
    const double step_px = kDense_m * finder.sketch_from_robot().scale();
    PathPoints rest = {Eigen::Vector2d::Zero()};
    const PathPoints ahead = rest_of(path_, finder.sketch_from_robot().translation());
    for (std::size_t i = 2; i < ahead.size(); ++i) {
      const Eigen::Vector2d side = ahead[i] - ahead[i - 1];
      const int parts = std::max(1, static_cast<int>(side.norm() / step_px));
      for (int part = 1; part <= parts; ++part) {
        rest.push_back(
            finder.robot_from_sketch(ahead[i - 1] + side * (static_cast<double>(part) / parts)));
      }
    }
    return rest.size() > 1 ? rest : PathPoints{};
  }

 private:
  const Sketch& sketch_;
  Eigen::Vector2d goal_in_sketch_;
  PlanParams params_;
  std::vector<ScaleSample> samples_;
  PathPoints path_;
};

bool was_seen(const Eigen::Vector2d& ahead_in_robot, const NearbyObstacles& obstacles,
              const Se2& odom_from_robot, double radius_m) {
  const Sketch window = obstacles.around(odom_from_robot);
  const Grid<float> distance = distance_field_px(window.occupied);
  const std::optional<float> cells = sample(distance, obstacles.cells_from_robot(ahead_in_robot));
  return cells && static_cast<double>(*cells) / *window.px_per_m < radius_m;
}

/// A drive to a goal, scan by scan.
class Navigator {
 public:
  Navigator(const NavigationTask& task, const NavigationParams& params, RobotFinder& finder,
            std::uint64_t seed)
      : params_(params),
        finder_(finder),
        goal_in_sketch_(task.drawing.sketch_from_world(task.goal_in_world)),
        way_(task.drawing.sketch, goal_in_sketch_, params.planning),
        obstacles_(params.nearby),
        seed_(seed) {}

  /// What to do after a scan; none: the drive is over.
  std::optional<Se2> next(const RunStep& measured) {
    finder_.step(measured);
    obstacles_.add(measured.scan, finder_.odom_from_robot());
    way_.add(finder_.sketch_from_robot());
    if (finder_.localized_probability() < params_.lost_below && looks_++ < params_.most_looks) {
      replan_in_m_ = 0.0;
      return turn_on_the_spot();
    }
    goal_in_robot_ = finder_.robot_from_sketch(goal_in_sketch_);
    if (goal_in_robot_.norm() < params_.look_m) {
      look_for_goal();
    }
    if (goal_in_robot_.norm() <= params_.arrived_m) {
      end_ = NavigationTrial::End::Arrived;
      return std::nullopt;
    }
    return drive_on();
  }

  NavigationTrial::End end() const { return end_; }
  const NearbyObstacles& obstacles() const { return obstacles_; }
  const PathPoints& path_in_sketch() const { return way_.path_in_sketch(); }

 private:
  Se2 turn_on_the_spot() const { return Se2::from_xy_yaw(0.0, 0.0, params_.follower.turn_rad); }

  /// The last metres: better than through the pose of the filter.
  void look_for_goal() {
    finder_.look();
    const Se2& odom_from_robot = finder_.odom_from_robot();
    goals_in_odom_.push_back(odom_from_robot * finder_.robot_from_sketch(goal_in_sketch_));
    if (goals_in_odom_.size() > static_cast<std::size_t>(params_.goal_looks)) {
      goals_in_odom_.pop_front();
    }
    std::vector<double> x_m;
    std::vector<double> y_m;
    for (const Eigen::Vector2d& goal : goals_in_odom_) {
      x_m.push_back(goal.x());
      y_m.push_back(goal.y());
    }
    goal_in_robot_ =
        odom_from_robot.inverse() * Eigen::Vector2d(quantile(x_m, 0.5), quantile(y_m, 0.5));
  }

  std::optional<Se2> drive_on() {
    if (replan_in_m_ <= 0.0) {
      way_.plan(seed_ + ++plans_);
      replan_in_m_ = params_.replan_m;
    }
    const bool is_near = goal_in_robot_.norm() < params_.straight_m;
    const NextStep step = next_step(
        is_near ? PathPoints{Eigen::Vector2d::Zero(), goal_in_robot_} : way_.rest_in_robot(finder_),
        obstacles_, finder_.odom_from_robot(), params_.follower);
    const bool gets_no_nearer =
        step.status == NextStep::Status::Blocked && goal_in_robot_.norm() <= params_.near_enough_m;
    if (step.status == NextStep::Status::Arrived || gets_no_nearer) {
      end_ = NavigationTrial::End::Arrived;
      return std::nullopt;
    }
    if (step.status == NextStep::Status::Blocked) {
      end_ = NavigationTrial::End::Stuck;
      replan_in_m_ = 0.0;
      return ++blocked_ < params_.most_blocked ? std::optional(turn_on_the_spot()) : std::nullopt;
    }
    const double step_m = step.robot_from_next.translation().norm();
    end_ = NavigationTrial::End::TooLong;
    blocked_ = step_m > 0.0 ? 0 : blocked_;
    looks_ = step_m > 0.0 && finder_.localized_probability() >= params_.lost_below ? 0 : looks_;
    replan_in_m_ -= step_m;
    return step.robot_from_next;
  }

  const NavigationParams& params_;
  RobotFinder& finder_;
  Eigen::Vector2d goal_in_sketch_;
  Eigen::Vector2d goal_in_robot_ = Eigen::Vector2d::Zero();
  std::deque<Eigen::Vector2d> goals_in_odom_;  ///< of the last looks
  DrawnWay way_;
  NearbyObstacles obstacles_;
  std::uint64_t seed_;
  std::uint64_t plans_ = 0;
  double replan_in_m_ = 0.0;
  int blocked_ = 0;
  int looks_ = 0;
  NavigationTrial::End end_ = NavigationTrial::End::TooLong;
};

double shortest_way_m(const NavigationTask& task, double radius_m) {
  Sketch map;
  map.occupied = task.building.map.cells;
  const FreeSpace space(map, ScaleField(1.0 / task.building.map.cell_m),
                        {.radius_m = radius_m - task.building.map.cell_m, .sigmas = 0.0},
                        Objective::Shortest);
  const GridSearch way =
      search_grid(space, task.building.map.cells_from_world(task.world_from_start.translation()),
                  task.building.map.cells_from_world(task.goal_in_world));
  return figures_of(pulled_straight(corners_of(way.path_in_sketch), space), space).length_m;
}

}  // namespace

void validate(const NavigationParams& params) {
  validate_part("planning", params.planning);
  validate_part("follower", params.follower);
  validate_part("nearby", params.nearby);
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
  require_above("least_way_m", params.least_way_m, 0.0);
  require_above("most_way_m", params.most_way_m, params.least_way_m);
}

NavigationTask navigation_task(const std::string& kind, int plan, const NavigationParams& params,
                               std::uint64_t seed) {
  DataSetParams of_drive;
  of_drive.person = kind == "tps" ? tps_person() : human_person();
  of_drive.drive.length_m = 40.0;
  of_drive.drive.robot_radius_m = params.follower.body.radius_m + 0.05;
  const DriveName name{.suite = kSuite, .plan = plan};
  DataSet made = simulated_drive(name, of_drive, seed);
  NavigationTask task{.set = kind + " " + std::to_string(plan),
                      .kind = kind,
                      .building = std::move(made.building),
                      .drawing = std::move(made.drawing),
                      .lidar = lidar_of(name),
                      .world_from_start = made.world_from_robot.begin()->pose};
  std::vector<Eigen::Vector2d> goals;
  for (const Stamped<Se2>& stamped : made.world_from_robot) {
    const double apart_m =
        (stamped.pose.translation() - task.world_from_start.translation()).norm();
    if (apart_m >= params.least_way_m && apart_m <= params.most_way_m) {
      goals.push_back(stamped.pose.translation());
    }
  }
  if (goals.empty()) {
    return navigation_task(kind, plan, params, seed + 1000003);  // a drive that goes nowhere
  }
  Rng rng = make_rng(seed, kGoalStream, static_cast<std::uint64_t>(plan));
  task.goal_in_world =
      goals[static_cast<std::size_t>(uniform(0.0, static_cast<double>(goals.size()), rng))];
  task.shortest_m = shortest_way_m(task, params.follower.body.radius_m);
  return task;
}

NavigationTrial navigate(const NavigationTask& task, const LocalizationMethod& method,
                         const LocalizationParams& localization, const NavigationParams& params,
                         WarpPredictor* predictor, std::uint64_t seed,
                         const std::function<double()>& clock) {
  constexpr double kCycle_s = 0.5;
  const double radius_m = params.follower.body.radius_m;
  SimulatedRobot robot(task, radius_m, seed);
  LocalizationParams seeded = localization;
  seeded.localizer.seed = seed;
  RobotFinder finder(task.drawing.sketch, method, seeded, predictor,
                     task.drawing.sketch_from_world.sketch_from_robot(task.world_from_start));
  Navigator navigator(task, params, finder, seed);
  NavigationTrial trial{.set = task.set, .kind = task.kind, .method = method.name};
  trial.shortest_m = task.shortest_m;
  trial.nearest_m = (task.goal_in_world - task.world_from_start.translation()).norm();
  for (int cycle = 0; cycle < params.most_cycles; ++cycle) {
    const RunStep measured = robot.measure(kCycle_s * cycle);
    const double begin_s = clock();
    const std::optional<Se2> step = navigator.next(measured);
    trial.cycle_ms.push_back(1e3 * (clock() - begin_s));
    trial.frames.push_back({.world_from_robot = robot.world_from_robot(),
                            .sketch_from_robot = finder.sketch_from_robot(),
                            .localized_probability = finder.localized_probability()});
    if (cycle == 0) {
      trial.first_path_in_sketch = navigator.path_in_sketch();
    }
    if (!step) {
      break;
    }
    const Eigen::Vector2d before = robot.world_from_robot().translation();
    const bool free = robot.drive(*step);
    const Eigen::Vector2d after = robot.world_from_robot().translation();
    trial.way_m += (after - before).norm();
    trial.nearest_m = std::min(trial.nearest_m, (after - task.goal_in_world).norm());
    trial.frames.back().collided = !free;
    trial.collisions += free ? 0 : 1;
    trial.seen_collisions += !free && was_seen(step->translation(), navigator.obstacles(),
                                               finder.odom_from_robot(), radius_m)
                                 ? 1
                                 : 0;
  }
  trial.end = navigator.end();
  trial.error_m = (robot.world_from_robot().translation() - task.goal_in_world).norm();
  return trial;
}

}  // namespace sketchloc

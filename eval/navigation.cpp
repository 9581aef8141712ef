#include "eval/navigation.hpp"

#include <algorithm>

#include "eval/simulated_robot.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kSeenBeams = 120;  ///< of a scan, enough to see what it saw

bool was_seen(const Eigen::Vector2d& ahead_in_robot, const NearbyObstacles& obstacles,
              const Se2& odom_from_robot, double radius_m) {
  const Sketch window = obstacles.around(odom_from_robot);
  const Grid<float> distance = distance_field_px(window.occupied);
  const std::optional<float> cells = sample(distance, obstacles.cells_from_robot(ahead_in_robot));
  return cells && static_cast<double>(*cells) / *window.px_per_m < radius_m;
}

std::vector<Eigen::Vector2d> seen_in_robot(const Scan& scan) {
  const std::vector<Eigen::Vector2d> all = end_points_in_robot(scan);
  const std::size_t every = 1 + all.size() / kSeenBeams;
  std::vector<Eigen::Vector2d> some;
  for (std::size_t i = 0; i < all.size(); i += every) {
    some.push_back(all[i]);
  }
  return some;
}

NavigationTrial::End end_of(Navigator::Status status) {
  switch (status) {
    case Navigator::Status::Drives:
      return NavigationTrial::End::TooLong;
    case Navigator::Status::Arrived:
      return NavigationTrial::End::Arrived;
    case Navigator::Status::Stuck:
      return NavigationTrial::End::Stuck;
  }
  return NavigationTrial::End::TooLong;
}

/// One drive, with what is noted of it.
class NotedDrive {
 public:
  NotedDrive(const NavigationTask& task, const NavigationParams& params, RobotFinder& finder,
             std::uint64_t seed)
      : task_(task),
        radius_m_(params.follower.body.radius_m),
        robot_(task, radius_m_, seed),
        finder_(finder),
        navigator_(task, params, finder, seed) {
    trial_.shortest_m = task.shortest_m;
    trial_.nearest_m = to_goal_m();
    trial_.paths_in_sketch = {navigator_.path_in_sketch()};
  }

  /// One scan and what is done after it; whether the drive goes on.
  bool cycle(double time_s, const NavigationClock& clock) {
    const RunStep measured = robot_.measure(time_s);
    const double begin_s = clock.wall_s();
    const double begin_processor_s = clock.processor_s();
    const std::optional<Se2> step = navigator_.next(measured);
    trial_.cycle_processor_ms.push_back(1e3 * (clock.processor_s() - begin_processor_s));
    trial_.cycle_ms.push_back(1e3 * (clock.wall_s() - begin_s));
    note(measured.scan);
    if (step) {
      move(*step);
    }
    return step.has_value();
  }

  NavigationTrial result() && {
    trial_.end = end_of(navigator_.status());
    trial_.error_m = to_goal_m();
    return std::move(trial_);
  }

 private:
  double to_goal_m() const {
    return (robot_.world_from_robot().translation() - task_.goal_in_world).norm();
  }

  void note(const Scan& scan) {
    if (navigator_.path_in_sketch() != trial_.paths_in_sketch.back()) {
      trial_.paths_in_sketch.push_back(navigator_.path_in_sketch());
    }
    trial_.frames.push_back({.world_from_robot = robot_.world_from_robot(),
                             .sketch_from_robot = finder_.sketch_from_robot(),
                             .position_covariance_px2 = finder_.position_covariance_px2(),
                             .localized_probability = finder_.localized_probability(),
                             .doing = navigator_.doing(),
                             .goal_in_robot = navigator_.goal_in_robot(),
                             .seen_in_robot = seen_in_robot(scan),
                             .path = trial_.paths_in_sketch.size() - 1});
  }

  void move(const Se2& step) {
    const Eigen::Vector2d before = robot_.world_from_robot().translation();
    const bool free = robot_.drive(step);
    trial_.way_m += (robot_.world_from_robot().translation() - before).norm();
    trial_.nearest_m = std::min(trial_.nearest_m, to_goal_m());
    if (!free) {
      trial_.frames.back().collided = true;
      ++trial_.collisions;
      trial_.seen_collisions +=
          was_seen(step.translation(), navigator_.obstacles(), finder_.odom_from_robot(), radius_m_)
              ? 1
              : 0;
    }
  }

  const NavigationTask& task_;
  double radius_m_;
  SimulatedRobot robot_;
  RobotFinder& finder_;
  Navigator navigator_;
  NavigationTrial trial_;
};

}  // namespace

NavigationTrial navigate(const NavigationTask& task, const NavigationMethod& by,
                         const NavigationParams& params, std::uint64_t seed,
                         const NavigationClock& clock) {
  LocalizationParams seeded = by.localization;
  seeded.localizer.seed = seed;
  seeded.localizer.start = params.start;
  RobotFinder finder(task.drawing.sketch, by.method, seeded, by.predictor,
                     task.drawing.sketch_from_world.sketch_from_robot(task.world_from_start));
  NotedDrive drive(task, params, finder, seed);
  for (int cycle = 0; cycle < params.most_cycles; ++cycle) {
    if (!drive.cycle(NavigationTrial::kCycle_s * cycle, clock)) {
      break;
    }
  }
  NavigationTrial trial = std::move(drive).result();
  trial.set = task.set;
  trial.kind = task.kind;
  trial.method = by.method.name;
  return trial;
}

}  // namespace sketchloc

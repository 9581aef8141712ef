#include "eval/navigation_task.hpp"

#include <utility>
#include <vector>

#include "eval/simulated_drive.hpp"
#include "motion/validate.hpp"
#include "planning/grid_search.hpp"
#include "planning/path.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSuite = 9000;  // buildings of no other suite
constexpr std::uint64_t kGoalStream = 9001;

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

/// Places of a drive that are as far from its start as is asked for.
std::vector<Eigen::Vector2d> goals_of(const MetricTrajectory& world_from_robot,
                                      const NavigationTaskParams& params) {
  const Eigen::Vector2d start = world_from_robot.begin()->pose.translation();
  std::vector<Eigen::Vector2d> goals;
  for (const Stamped<Se2>& stamped : world_from_robot) {
    const double apart_m = (stamped.pose.translation() - start).norm();
    if (apart_m >= params.least_way_m && apart_m <= params.most_way_m) {
      goals.push_back(stamped.pose.translation());
    }
  }
  return goals;
}

}  // namespace

void validate(const NavigationTaskParams& params) {
  require_above("least_way_m", params.least_way_m, 0.0);
  require_above("most_way_m", params.most_way_m, params.least_way_m);
}

NavigationTask navigation_task(const std::string& kind, int plan,
                               const NavigationTaskParams& params, double radius_m,
                               std::uint64_t seed) {
  DataSetParams of_drive;
  of_drive.person = kind == "tps" ? tps_person() : human_person();
  of_drive.drive.length_m = 40.0;
  of_drive.drive.robot_radius_m = radius_m + 0.05;
  const DriveName name{.suite = kSuite, .plan = plan};
  DataSet made = simulated_drive(name, of_drive, seed);
  NavigationTask task{.set = kind + " " + std::to_string(plan),
                      .kind = kind,
                      .building = std::move(made.building),
                      .drawing = std::move(made.drawing),
                      .lidar = lidar_of(name),
                      .world_from_start = made.world_from_robot.begin()->pose};
  const std::vector<Eigen::Vector2d> goals = goals_of(made.world_from_robot, params);
  if (goals.empty()) {
    return navigation_task(kind, plan, params, radius_m,
                           seed + 1000003);  // a drive that goes nowhere
  }
  Rng rng = make_rng(seed, kGoalStream, static_cast<std::uint64_t>(plan));
  task.goal_in_world =
      goals[static_cast<std::size_t>(uniform(0.0, static_cast<double>(goals.size()), rng))];
  task.shortest_m = shortest_way_m(task, radius_m);
  return task;
}

}  // namespace sketchloc

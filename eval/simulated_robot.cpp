#include "eval/simulated_robot.hpp"

#include <algorithm>
#include <optional>

#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kWorldStream = 9002;
constexpr double kStepCheck_m = 0.02;

}  // namespace

SimulatedRobot::SimulatedRobot(const NavigationTask& task, double radius_m, std::uint64_t seed)
    : map_(task.building.map),
      clearance_cells_(distance_field_px(map_.cells)),
      lidar_(map_, task.lidar),
      rng_(make_rng(seed, kWorldStream)),
      wheels_(OdometryModel{}, rng_),
      radius_m_(radius_m),
      world_from_robot_(task.world_from_start) {}

RunStep SimulatedRobot::measure(double time_s) {
  return {.scan = lidar_.scan(world_from_robot_, time_s, rng_),
          .odom_from_robot = odom_from_robot_};
}

bool SimulatedRobot::drive(const Se2& robot_from_next) {
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

bool SimulatedRobot::fits(const Eigen::Vector2d& point_in_world) const {
  const std::optional<float> cells =
      sample(clearance_cells_, map_.cells_from_world(point_in_world));
  // to the edge of the nearest cell, but for rounding of the disc to cells
  return !cells || (static_cast<double>(*cells) - 0.5) * map_.cell_m >= radius_m_ - map_.cell_m;
}

}  // namespace sketchloc

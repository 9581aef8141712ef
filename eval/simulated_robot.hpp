#pragma once

#include <cstdint>

#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/odometry_model.hpp"
#include "eval/navigation_task.hpp"

namespace sketchloc {

/// The true robot, a disc, among the true things. What stands in its way stops it.
class SimulatedRobot {
 public:
  /// The task must outlive the robot.
  SimulatedRobot(const NavigationTask& task, double radius_m, std::uint64_t seed);

  RunStep measure(double time_s);

  /// Drives as far as nothing is in its way; false where something was. The wheels turn all the
  /// same: they measure what was driven.
  bool drive(const Se2& robot_from_next);

  const Se2& world_from_robot() const { return world_from_robot_; }

 private:
  bool fits(const Eigen::Vector2d& point_in_world) const;

  const MetricMap& map_;
  Grid<float> clearance_cells_;
  LidarSimulator lidar_;
  Rng rng_;
  OdometrySimulator wheels_;
  double radius_m_;
  Se2 world_from_robot_;
  Se2 odom_from_robot_;
};

}  // namespace sketchloc

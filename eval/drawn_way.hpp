#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "eval/robot_finder.hpp"
#include "planning/planner.hpp"
#include "planning/scale_field.hpp"

namespace sketchloc {

/// The way to a goal in a drawing, by the scales that the robot found in it so far.
class DrawnWay {
 public:
  DrawnWay(const Sketch& sketch, const Eigen::Vector2d& goal_in_sketch, const PlanParams& params);

  /// Takes the pose that the robot believes in.
  void add(const Sim2& sketch_from_robot);

  /// A new way from the last pose; what is left of the old one helps.
  void plan(std::uint64_t seed);

  /// Whether there is a way and the last pose is no farther from it.
  bool is_on_way(double within_m) const;

  const PathPoints& path_in_sketch() const { return path_; }

  /// The rest of the way from the robot on, in its metres.
  PathPoints rest_in_robot(const RobotFinder& finder) const;

 private:
  Grid<float> stroke_distance_px_;
  Eigen::Vector2d goal_in_sketch_;
  PlanParams params_;
  Sim2 sketch_from_robot_;
  std::vector<ScaleSample> samples_;
  PathPoints path_;
};

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <vector>

#include "datasets/scan.hpp"
#include "eval/detail/run_picture.hpp"
#include "motion/sim2.hpp"

namespace sketchloc::detail {

/// Arrow head of a robot in the sketch frame; size in the robot's metres, about its length.
Polyline robot_outline(const Sim2& sketch_from_robot, double size_m);

/// A scan's end points as the drawing would have them at a pose.
std::vector<Eigen::Vector2d> end_points_in_sketch(const Scan& scan, const Sim2& sketch_from_robot);

}  // namespace sketchloc::detail

#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "motion/se2.hpp"

namespace sketchloc {

class StateReader;
class StateWriter;

/// One turn of a planar LIDAR. Beam i points at first_angle_rad + i * angle_step_rad in the laser
/// frame (0 = forward, counter-clockwise positive). A range outside [min_range_m, max_range_m), of
/// 0 or less, or NaN, is no return.
struct Scan {
  double time_s = 0.0;
  double first_angle_rad = 0.0;
  double angle_step_rad = 0.0;
  double min_range_m = 0.0;
  double max_range_m = 0.0;
  Se2 robot_from_laser;
  std::vector<float> ranges_m;

  double angle_rad(std::size_t beam) const {
    return first_angle_rad + static_cast<double>(beam) * angle_step_rad;
  }
  // Ranges are compared as they are kept, in float: a reading of the limit itself is the limit.
  bool is_in_reach_or_beyond(std::size_t beam) const {
    const float range_m = ranges_m[beam];
    return range_m > 0.0F && range_m >= static_cast<float>(min_range_m);  // false for NaN
  }
  bool is_return(std::size_t beam) const {
    return is_in_reach_or_beyond(beam) && ranges_m[beam] < static_cast<float>(max_range_m);
  }
};

/// Bit for bit, for states that are read back.
void save(const Scan& scan, StateWriter& state);
Scan load_scan(StateReader& state);

/// The end points of the beams that returned, in beam order.
std::vector<Eigen::Vector2d> end_points_in_robot(const Scan& scan);

}  // namespace sketchloc

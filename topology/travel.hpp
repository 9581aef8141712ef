#pragma once

#include <span>
#include <vector>

#include "motion/se2.hpp"

namespace sketchloc {

/// How far a robot has come and how much it has turned, pose by pose.
struct Travel {
  std::vector<double> way_m;    ///< since the first pose, along the path; never decreases
  std::vector<double> yaw_rad;  ///< heading of the robot, unwrapped
};

Travel travel_of(std::span<const Se2> odom_from_robot);

/// The poses with the same steps, seen from the robot, but other headings. The first position
/// stays. Sizes must agree.
std::vector<Se2> with_headings(std::span<const Se2> odom_from_robot,
                               std::span<const double> yaw_rad);

/// A multiple of 90 deg as an angle.
double angle_rad(int quarter_turns);
/// How many quarter turns are nearest to an angle.
int nearest_quarter_turns(double angle_rad);

}  // namespace sketchloc

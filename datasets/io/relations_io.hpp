#pragma once

#include <filesystem>
#include <vector>

#include "motion/se2.hpp"

namespace sketchloc {

/// A relative pose between two instants of a run, checked by hand: ground truth for odometry.
struct Relation {
  double first_time_s = 0.0;
  double second_time_s = 0.0;
  Se2 first_from_second;  ///< the robot's second pose in the frame of its first
};

/// Reads a relations file of the SLAM benchmark (t1 t2 dx dy dz roll pitch yaw per line). Motion
/// out of the plane is an error. Throws std::runtime_error with file, line and field.
std::vector<Relation> read_relations(const std::filesystem::path& relations);

}  // namespace sketchloc

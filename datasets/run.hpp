#pragma once

#include <string>
#include <vector>

#include "datasets/scan.hpp"
#include "motion/se2.hpp"

namespace sketchloc {

/// A scan with the odometry at its instant: raw, drifting, never corrected.
struct RunStep {
  Scan scan;
  Se2 odom_from_robot;
};

/// A logged drive: steps in the order of the log, times not decreasing.
struct Run {
  std::vector<RunStep> steps;
};

}  // namespace sketchloc

#pragma once

#include <optional>

#include "datasets/scan.hpp"
#include "motion/se2.hpp"

namespace sketchloc {

/// What a robot says while it drives: where its wheels believe it to be, what its laser sees, or
/// both of one instant.
struct Message {
  double time_s = 0.0;
  std::optional<Se2> odom_from_robot;  ///< raw, drifting
  std::optional<Scan> scan;            ///< of the same time
};

}  // namespace sketchloc

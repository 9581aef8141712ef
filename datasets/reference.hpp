#pragma once

#include <cstddef>
#include <vector>

#include "motion/sim2.hpp"

namespace sketchloc {

/// Where the robot is in the drawing at one step of a run, made by hand or by the simulator.
/// For evaluation only, never for the localizer.
struct ReferencePose {
  std::size_t step = 0;  ///< index of the scan in the run
  double time_s = 0.0;
  Sim2 sketch_from_robot;      ///< heading = rotation part of the local map; scale = local px/m
  double uncertainty_m = 0.0;  ///< 1-sigma of the reference itself, in local metres; 0 if exact
  bool scored = true;          ///< false where the pose lies outside the drawing or its support
};

struct Reference {
  std::vector<ReferencePose> poses;  ///< at most one per step, steps increasing
};

}  // namespace sketchloc

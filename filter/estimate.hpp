#pragma once

#include <Eigen/Core>
#include <vector>

#include "motion/sim2.hpp"

namespace sketchloc {

/// One cluster of particles.
struct Mode {
  Sim2 sketch_from_robot;      ///< weighted mean
  Eigen::Matrix4d covariance;  ///< of (x px, y px, heading rad, log scale), sketch frame
  double weight = 0.0;         ///< share of the whole weight, in (0, 1]
};

/// What the filter believes after one step.
struct Estimate {
  Sim2 sketch_from_robot;  ///< mean of the heaviest mode
  Eigen::Matrix4d covariance =
      Eigen::Matrix4d::Zero();  ///< of that mode: (x px, y px, heading rad, log scale)
  std::vector<Mode> modes;      ///< heaviest first
};

}  // namespace sketchloc

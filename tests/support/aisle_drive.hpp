#pragma once

#include <vector>

#include "datasets/place_label.hpp"
#include "motion/random.hpp"
#include "motion/se2.hpp"

namespace sketchloc::testing {

/// A robot that goes up one aisle and down the next, twice through the whole building.
struct AisleDrive {
  std::vector<Se2> world_from_robot;
  std::vector<Se2> odom_from_robot;  ///< the first pose is the world's
  std::vector<PlaceLabel> labels;
};

struct AisleDriveParams {
  int aisles = 6;
  double aisle_m = 12.0;
  double spacing_m = 3.0;
  double drift_deg_per_m = 0.0;    ///< steady
  double turn_error_deg = 0.0;     ///< 1-sigma of a quarter turn
  double first_heading_deg = 0.0;  ///< of the odometry against the walls
};

AisleDrive aisle_drive(const AisleDriveParams& params, Rng& rng);

/// Mean distance of two lists of poses, with the second laid onto the first.
double mean_distance_m(const std::vector<Se2>& reference, const std::vector<Se2>& poses);

}  // namespace sketchloc::testing

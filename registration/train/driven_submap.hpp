#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "datasets/scan.hpp"
#include "motion/odometry.hpp"
#include "motion/random.hpp"
#include "motion/trajectory.hpp"
#include "registration/scan_raster.hpp"

namespace sketchloc {

/// A number in [0, count), all equally likely.
std::size_t draw_index(std::size_t count, Rng& rng);

/// How scans of the last metres are remembered.
struct DrivenSubmapParams {
  int min_scans = 1;  ///< how many there are is drawn; fewer at the start of a drive, >= 1
  int max_scans = 6;  ///< >= min_scans
  double scan_spacing_m = 0.7;  ///< >= 0
  OdometryNoise noise;          ///< as scan matching leaves it
};

/// The submap of scan `present` of a drive, that scan first, then back in time; the scans are not
/// owned. One scan for each pose of the drive.
std::vector<PlacedScan> draw_driven_submap(const MetricTrajectory& drive,
                                           std::span<const Scan> scans, std::size_t present,
                                           const DrivenSubmapParams& params, Rng& rng);

}  // namespace sketchloc

#pragma once

#include <span>

#include "datasets/grid.hpp"
#include "datasets/scan.hpp"
#include "motion/se2.hpp"
#include "registration/local_window.hpp"

namespace sketchloc {

/// A scan of a submap: taken at an earlier pose, seen from the present one.
struct PlacedScan {
  const Scan* scan = nullptr;  ///< not owned
  Se2 robot_from_then{};       ///< the robot's pose at the scan, in the present robot frame
};

/// What scans saw, top-down, on the cells of a window.
struct ScanRaster {
  Grid<float> end_points;  ///< end points shared out to the four nearest cells, at most 1
  Grid<float> seen_free;   ///< 1 where a beam passed, 0 where none did, between at the border
};

/// Rasters one scan or several; takes about 20 us per scan at 64 x 64 cells. Beams without a
/// return say nothing.
ScanRaster raster_scans(std::span<const PlacedScan> scans, const LocalWindow& window);

/// 1 in the cells that an end point falls into, else 0: the scan image of [Chen20].
Grid<float> binary_scan_raster(const Scan& scan, const LocalWindow& window);

/// The seen_free of a single scan.
Grid<float> raster_free_space(const Scan& scan, const LocalWindow& window);

}  // namespace sketchloc

#pragma once

#include <span>

#include "registration/local_window.hpp"
#include "registration/scan_raster.hpp"
#include "registration/sketch_crop.hpp"
#include "registration/warp.hpp"

namespace sketchloc {

/// How well what a robot sees lies on the strokes of a drawing, in [0, 1]: the mean over the end
/// points in the window of exp(-d^2 / 2 sigma^2), d their distance to the nearest stroke in metres
/// by the local scale at the robot, sigma 0.15 m. 0 without an end point, 1 where all lie on
/// strokes. It needs no reference, and cannot tell places that look alike; furniture that nobody
/// drew keeps it below 1.
double alignment_score(std::span<const PlacedScan> submap, const SketchCropper& drawing,
                       const Warp& warp, const LocalWindow& window);

/// The same for a drawing that is taken to be true around the robot.
double alignment_score(std::span<const PlacedScan> submap, const SketchCropper& drawing,
                       const Sim2& sketch_from_robot, const LocalWindow& window);

}  // namespace sketchloc

#pragma once

#include <span>
#include <vector>

#include "registration/local_window.hpp"
#include "registration/scan_raster.hpp"
#include "registration/sketch_crop.hpp"

namespace sketchloc {

/// What a registration network looks at: `Published` is the pair of binary pictures of [Chen20],
/// `Residual` the scan and the drawing in the frame of the prior.
enum class InputKind { Published, Residual };

/// Published: scan, crop. Residual: end points, seen free, strokes, nearness, visible free.
constexpr int channels_of(InputKind kind) { return kind == InputKind::Published ? 2 : 5; }

/// The side of the published crop: [Chen20] knows one scale for all drawings.
constexpr double kPublishedPxPerM = 20.0;
constexpr double published_crop_side_px(const LocalWindow& window) {
  return kPublishedPxPerM * window.side_m;
}

/// Planes of window.cells^2 values, one channel after the other, each row by row from the right of
/// the robot (row 0), as Grid has them; one such input after the other, for each prior. `submap` is
/// not empty; the present scan comes first. The published input takes nothing else, and of the
/// prior only the position.
std::vector<float> network_input(InputKind kind, std::span<const PlacedScan> submap,
                                 const SketchCropper& sketch,
                                 std::span<const Sim2> priors_sketch_from_robot,
                                 const LocalWindow& window);

}  // namespace sketchloc

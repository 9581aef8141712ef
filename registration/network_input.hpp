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

/// Names of a network's inputs: scan and drawing each for itself, so that one scan does for several
/// drawings (residual), or one on top of the other (published).
inline constexpr const char* kScanInput = "scan";
inline constexpr const char* kDrawingInput = "drawing";
inline constexpr const char* kStackedInput = "input";

/// The first channels are the scan's, the same for all priors.
constexpr int scan_channels_of(InputKind kind) { return kind == InputKind::Published ? 1 : 2; }

/// Planes of window.cells^2 values, one channel after the other, each row by row from the right of
/// the robot (row 0), as Grid has them. `submap` is not empty; the present scan comes first. The
/// published input takes no other.
std::vector<float> scan_input(InputKind kind, std::span<const PlacedScan> submap,
                              const LocalWindow& window);

/// The drawing's planes likewise. The published input takes only the position of the prior.
std::vector<float> drawing_input(InputKind kind, const SketchCropper& sketch,
                                 const Sim2& prior_sketch_from_robot, const LocalWindow& window);

/// The scan's planes, then the drawing's.
std::vector<float> network_input(InputKind kind, std::span<const PlacedScan> submap,
                                 const SketchCropper& sketch, const Sim2& prior_sketch_from_robot,
                                 const LocalWindow& window);

}  // namespace sketchloc

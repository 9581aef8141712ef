#include "registration/network_input.hpp"

#include "motion/check.hpp"

namespace sketchloc {
namespace {

void append(std::vector<float>& planes, const Grid<float>& channel) {
  planes.insert(planes.end(), channel.cells().begin(), channel.cells().end());
}

}  // namespace

std::vector<float> scan_input(InputKind kind, std::span<const PlacedScan> submap,
                              const LocalWindow& window) {
  check(!submap.empty(), "a submap has a scan");
  std::vector<float> planes;
  if (kind == InputKind::Published) {
    append(planes, binary_scan_raster(*submap.front().scan, window));
  } else {
    const ScanRaster seen = raster_scans(submap, window);
    append(planes, seen.end_points);
    append(planes, seen.seen_free);
  }
  return planes;
}

std::vector<float> drawing_input(InputKind kind, const SketchCropper& sketch,
                                 const Sim2& prior_sketch_from_robot, const LocalWindow& window) {
  std::vector<float> planes;
  if (kind == InputKind::Published) {
    append(planes, sketch.upright_crop(prior_sketch_from_robot.translation(),
                                       published_crop_side_px(window), window.cells));
  } else {
    const SketchCrop drawn = sketch.crop(prior_sketch_from_robot, window);
    append(planes, drawn.strokes);
    append(planes, drawn.nearness);
    append(planes, drawn.visible_free);
  }
  return planes;
}

std::vector<float> network_input(InputKind kind, std::span<const PlacedScan> submap,
                                 const SketchCropper& sketch, const Sim2& prior_sketch_from_robot,
                                 const LocalWindow& window) {
  std::vector<float> planes = scan_input(kind, submap, window);
  const std::vector<float> drawn = drawing_input(kind, sketch, prior_sketch_from_robot, window);
  planes.insert(planes.end(), drawn.begin(), drawn.end());
  return planes;
}

}  // namespace sketchloc

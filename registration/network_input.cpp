#include "registration/network_input.hpp"

#include "motion/check.hpp"

namespace sketchloc {
namespace {

void append(std::vector<float>& planes, const Grid<float>& channel) {
  planes.insert(planes.end(), channel.cells().begin(), channel.cells().end());
}

}  // namespace

std::vector<float> network_input(InputKind kind, std::span<const PlacedScan> submap,
                                 const SketchCropper& sketch,
                                 std::span<const Sim2> priors_sketch_from_robot,
                                 const LocalWindow& window) {
  check(!submap.empty(), "a submap has a scan");
  std::vector<float> planes;
  planes.reserve(priors_sketch_from_robot.size() *
                 static_cast<std::size_t>(channels_of(kind) * window.cells * window.cells));
  if (kind == InputKind::Published) {
    const Grid<float> seen = binary_scan_raster(*submap.front().scan, window);
    for (const Sim2& prior : priors_sketch_from_robot) {
      append(planes, seen);
      append(planes, sketch.upright_crop(prior.translation(), published_crop_side_px(window),
                                         window.cells));
    }
    return planes;
  }
  const ScanRaster seen = raster_scans(submap, window);
  for (const Sim2& prior : priors_sketch_from_robot) {
    const SketchCrop drawn = sketch.crop(prior, window);
    append(planes, seen.end_points);
    append(planes, seen.seen_free);
    append(planes, drawn.strokes);
    append(planes, drawn.nearness);
    append(planes, drawn.visible_free);
  }
  return planes;
}

}  // namespace sketchloc

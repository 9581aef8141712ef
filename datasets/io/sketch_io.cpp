#include "datasets/io/sketch_io.hpp"

#include "datasets/io/detail/ink.hpp"
#include "datasets/io/detail/picture.hpp"
#include "datasets/io/detail/place.hpp"
#include "datasets/io/image_rows.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
void validate(const SketchReading& reading) {
  if (reading.dirt_px) {
    require_at_least("dirt_px", *reading.dirt_px, 0.0);
  }
  require_above("max_pixels", static_cast<double>(reading.max_pixels), 0.0);
}

Sketch read_sketch(const std::filesystem::path& picture, const SketchReading& reading) {
  validate(reading);
  const detail::Ink ink =
      detail::find_ink(detail::read_picture(picture, reading.max_pixels), reading);
  if (ink.occupied.empty()) {
    detail::fail({.file = picture},
                 "drawing: expected strokes or painted free space, found a blank picture; raise "
                 "the contrast, or say how it is drawn with --polarity and --drawn");
  }
  return {.occupied = mask_from_image(ink.occupied), .kind = ink.kind, .px_per_m = std::nullopt};
}

Sketch read_any_drawing(const std::filesystem::path& drawing, const SketchReading& reading) {
  const bool is_yaml = drawing.extension() == ".yaml" || drawing.extension() == ".yml";
  return is_yaml ? read_map_server(drawing, reading) : read_sketch(drawing, reading);
}

}  // namespace sketchloc

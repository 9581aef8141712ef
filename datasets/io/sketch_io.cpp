#include "datasets/io/sketch_io.hpp"

#include "datasets/io/detail/ink.hpp"
#include "datasets/io/detail/picture.hpp"
#include "datasets/io/detail/place.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// The one place where the rows of a picture (top first) become rows of a drawing (bottom first).
Grid<std::uint8_t> grid_of(const cv::Mat1b& occupied) {
  Grid<std::uint8_t> grid(occupied.cols, occupied.rows);
  for (int row = 0; row < occupied.rows; ++row) {
    const unsigned char* from = occupied.ptr(occupied.rows - 1 - row);
    const std::span<std::uint8_t> to = grid.row(row);
    for (std::size_t column = 0; column < to.size(); ++column) {
      to[column] = from[column] != 0 ? 1 : 0;
    }
  }
  return grid;
}

}  // namespace

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
                 "the contrast, or give polarity and kind");
  }
  return {.occupied = grid_of(ink.occupied), .kind = ink.kind, .px_per_m = std::nullopt};
}

}  // namespace sketchloc

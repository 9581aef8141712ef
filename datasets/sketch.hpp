#pragma once

#include <cstdint>
#include <optional>

#include "datasets/grid.hpp"

namespace sketchloc {

/// A drawing as a plane: frame `sketch`, 1 px per cell, x right, y up, origin at the lower left
/// corner of the lower left pixel (the centre of that pixel is at (0.5, 0.5)).
struct Sketch {
  enum class Kind {
    Strokes,         ///< lines are obstacles, everything else may be free
    FilledFreeSpace  ///< painted free space; everything else is obstacle
  };

  Grid<std::uint8_t> occupied;  ///< 1 where a stroke or other obstacle is, else 0
  Kind kind = Kind::Strokes;
  std::optional<double> px_per_m;  ///< known only for metric maps (map_server)

  int width_px() const { return occupied.width(); }
  int height_px() const { return occupied.height(); }
};

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "datasets/sketch.hpp"

namespace sketchloc {

/// How a drawing is read. What is not given is found from the picture; docs/formats.md says how.
struct SketchReading {
  enum class Polarity {
    DarkOnLight,  ///< dark strokes (or dark painted free space) on a light ground
    LightOnDark   ///< light strokes (or light painted free space) on a dark ground
  };

  std::optional<Polarity> polarity = std::nullopt;
  std::optional<Sketch::Kind> kind = std::nullopt;
  /// Blobs of ink smaller than this in both directions are dirt; by default 0.3 % of the
  /// diagonal, at least 3 px. Only for strokes. In px, >= 0.
  std::optional<double> dirt_px = std::nullopt;
  std::size_t max_pixels = 40'000'000;  ///< larger pictures are an error, > 0
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const SketchReading& reading);

/// Reads a drawing from PNG, JPEG or PGM/PPM/PBM: line drawings and filled free space, either
/// polarity, with or without transparency, also photos of paper in uneven light. Throws
/// std::runtime_error with the file and the reason; a picture without ink is an error.
Sketch read_sketch(const std::filesystem::path& picture, const SketchReading& reading = {});

/// Reads a metric map: the YAML file of ROS map_server (modes trinary and scale) with its picture.
/// Known scale; occupied where map_server says so. Unknown cells count as not occupied. Of
/// `reading` only max_pixels matters.
Sketch read_map_server(const std::filesystem::path& yaml, const SketchReading& reading = {});

/// read_map_server for .yaml and .yml, else read_sketch.
Sketch read_any_drawing(const std::filesystem::path& drawing, const SketchReading& reading = {});

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>

#include "datasets/sketch.hpp"

namespace sketchloc {

/// Writes a drawing as PNG, atomically: occupied black on white, one px per cell. read_sketch gives
/// the same drawing back (but for specks that it takes for dirt).
void write_sketch(const std::filesystem::path& png, const Sketch& sketch);

/// Writes a picture for people, atomically: the drawing in grey, enlarged where it is small, with a
/// path on it from a ring (start) to a dot (end).
void write_path_picture(const std::filesystem::path& png, const Sketch& sketch,
                        std::span<const Eigen::Vector2d> path_in_sketch);

}  // namespace sketchloc

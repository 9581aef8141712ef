#pragma once

#include <filesystem>

#include "motion/trajectory.hpp"

namespace sketchloc {

/// Reads a TUM trajectory (t x y z qx qy qz qw per line, # comments): poses in the plane. A
/// rotation about another axis than z is an error, z is ignored, and so are poses in a drawing.
/// Throws std::runtime_error with file, line and field.
MetricTrajectory read_tum(const std::filesystem::path& tum);

/// Writes metres, z = 0, atomically.
void write_tum(const std::filesystem::path& tum, const MetricTrajectory& trajectory);

/// Writes x and y in px of the frame `sketch`, z = 0, heading as rotation about z. TUM has no place
/// for the local scale. A comment names the frame, so that nobody takes px for metres.
void write_tum(const std::filesystem::path& tum, const SketchTrajectory& trajectory);

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "datasets/reference.hpp"

namespace sketchloc {

/// Reads a reference CSV. Its poses are in the image convention (x right, y down, origin at the
/// centre of the top left pixel, heading clockwise); what comes back is in the frame `sketch`.
/// Heading: heading_rigid_rad. Scored: in_image and in_hull. Format: docs/formats.md.
Reference read_reference(const std::filesystem::path& csv, int sketch_height_px);

/// Writes the same columns, atomically. Those that a Reference does not know are "nan"; heading_rad
/// repeats the rigid heading; in_image and in_hull are both `scored`.
void write_reference(const std::filesystem::path& csv, const Reference& reference,
                     int sketch_height_px);

/// A pose that counts as right as well, under another reading of the drawing.
struct AlternativePose {
  std::size_t step = 0;  ///< index of the scan in the run
  double time_s = 0.0;
  Sim2 sketch_from_robot;    ///< heading: of the warped forward axis, not the rigid one
  double distance_px = 0.0;  ///< to the pose of the reference
};

/// Reads the CSV of another reading of the drawing, in the image convention as above.
std::vector<AlternativePose> read_alternative(const std::filesystem::path& csv,
                                              int sketch_height_px);

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "datasets/scan.hpp"
#include "datasets/sketch.hpp"
#include "motion/sim2.hpp"

namespace sketchloc {

/// A place in a drawing as people type it.
struct StartPose {
  Eigen::Vector2d place_in_sketch = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  std::optional<double> px_per_m;  ///< none: to be found
};

/// Reads "X,Y,HEADING_DEG" or "X,Y,HEADING_DEG,PX_PER_M". Throws std::invalid_argument saying what
/// is wrong with it and with which flag.
StartPose parse_start_pose(std::string_view text, const std::string& flag = "--start");

/// A drawing with the name that people know it by.
struct NamedSketch {
  const Sketch& sketch;
  std::filesystem::path file;
};

/// The same for a drawing. Throws std::invalid_argument too where the place is outside of it or the
/// scale makes no building of it.
StartPose start_pose_in(std::string_view text, const std::string& flag, const NamedSketch& drawing);

/// The pose that is meant; where no scale was given, that of a metric map, else the scale that the
/// scan there suggests, with a note; none where nothing tells it.
std::optional<Sim2> pose_at(const StartPose& start, const std::string& flag, const Sketch& sketch,
                            const Scan& scan);

/// The pose that a text means in a drawing; where the text has no scale, that of a metric map, else
/// the scale that the scan there suggests, with a note. Throws std::invalid_argument where the
/// place is outside of the drawing or the scale makes no building of it, std::runtime_error where
/// nothing tells the scale.
Sim2 pose_in_drawing(std::string_view text, const std::string& flag, const NamedSketch& drawing,
                     const Scan& scan);

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace sketchloc {

/// A place in a drawing as people type it.
struct StartPose {
  Eigen::Vector2d place_in_sketch = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  std::optional<double> px_per_m;  ///< none: to be found
};

/// Reads "X,Y,HEADING_DEG" or "X,Y,HEADING_DEG,PX_PER_M". Throws std::invalid_argument saying what
/// is wrong with it.
StartPose parse_start_pose(std::string_view text);

}  // namespace sketchloc

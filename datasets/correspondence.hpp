#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace sketchloc {

/// One place that somebody found in a drawing and in a model (a true map) of the same building.
struct Correspondence {
  std::size_t match = 0;            ///< its number in the file
  Eigen::Vector2d point_in_sketch;  ///< px
  Eigen::Vector2d point_in_model;   ///< px of the model's picture, y up like a sketch
};

}  // namespace sketchloc

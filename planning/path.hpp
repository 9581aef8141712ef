#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "planning/free_space.hpp"

namespace sketchloc {

/// Corners of a way in the drawing (sketch frame), from start to goal.
using PathPoints = std::vector<Eigen::Vector2d>;

/// A way in real metres.
struct PathFigures {
  double length_m = 0.0;
  double cost_m = 0.0;  ///< length as the objective sees it
  double least_clearance_m = 0.0;
  double mean_clearance_m = 0.0;
  int crossings = 0;  ///< strokes that are crossed
};

PathFigures figures_of(std::span<const Eigen::Vector2d> path_in_sketch, const FreeSpace& space);

/// Whether all of a way is free.
bool is_free(std::span<const Eigen::Vector2d> path_in_sketch, const FreeSpace& space);

/// What is left of a way for somebody who is at a point near it: the point, then the way from its
/// place nearest to it on. None of an empty way.
PathPoints rest_of(std::span<const Eigen::Vector2d> path_in_sketch,
                   const Eigen::Vector2d& point_in_sketch);

/// The corners alone, without the points between them.
PathPoints corners_of(std::span<const Eigen::Vector2d> path_in_sketch);

/// Straight lines instead of detours: from each corner to the last one that can be reached so,
/// where that is free and costs no more.
PathPoints pulled_straight(std::span<const Eigen::Vector2d> path_in_sketch, const FreeSpace& space);

}  // namespace sketchloc

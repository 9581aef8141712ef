#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace sketchloc::detail {

/// Points joined by straight lines, in any frame.
using Polyline = std::vector<Eigen::Vector2d>;

double length(std::span<const Eigen::Vector2d> line);

/// The same line (at least one point) with points at most `spacing` apart: each straight piece is
/// cut into equal parts.
Polyline resample(std::span<const Eigen::Vector2d> line, double spacing);

/// The fewest points of a line that stay within a tolerance of it. [DouglasPeucker73]
Polyline simplify(std::span<const Eigen::Vector2d> line, double tolerance);

/// Distance of a point from the straight piece between two others.
double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to);

}  // namespace sketchloc::detail

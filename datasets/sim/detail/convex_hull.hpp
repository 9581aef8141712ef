#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace sketchloc::detail {

/// The corners of the convex hull, counter-clockwise, without points on its sides. Fewer than three
/// where the points lie on one line.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

/// Is the point in the hull or on its border? Hulls without an area hold nothing.
bool is_inside(std::span<const Eigen::Vector2d> hull, const Eigen::Vector2d& point);

}  // namespace sketchloc::detail

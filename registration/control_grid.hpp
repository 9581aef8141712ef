#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace sketchloc {

/// Control points per side of the warps that networks predict. [Chen20]
inline constexpr int kControlsPerSide = 4;
inline constexpr int kControls = kControlsPerSide * kControlsPerSide;

/// points_per_side^2 points (at least 2 per side) that span a square, corners included: row by row
/// from the lowest y, each row from the lowest x.
std::vector<Eigen::Vector2d> square_lattice(int points_per_side, double side,
                                            const Eigen::Vector2d& centre);

/// E with f(points[i]) = sum_j E(i, j) values[j] for the thin plate spline f through values at
/// control points that define one.
Eigen::MatrixXd spline_matrix(std::span<const Eigen::Vector2d> control_points,
                              std::span<const Eigen::Vector2d> points);

}  // namespace sketchloc

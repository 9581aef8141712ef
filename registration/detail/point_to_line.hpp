#pragma once

#include <Eigen/Core>
#include <span>

#include "motion/se2.hpp"
#include "registration/surface_map.hpp"
#include "registration/surface_points.hpp"

namespace sketchloc::detail {

/// Gauss-Newton terms of the robust point-to-line misfit for a step d, odom_from_robot * exp(d),
/// in square metres.
struct PointToLine {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d half_gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;       ///< sum of rho; a point without partner costs all of the kernel
  int partners = 0;        ///< points with a partner in the map
  int close_partners = 0;  ///< of those, closer to its line than the kernel
};

/// Robust kernel of Geman and McClure: rho(r) = r^2 / (1 + r^2 / kernel^2).
PointToLine linearize_point_to_line(std::span<const SurfacePoint> points_in_robot,
                                    const SurfaceMap& map_in_odom, const Se2& odom_from_robot,
                                    double kernel_m);

}  // namespace sketchloc::detail

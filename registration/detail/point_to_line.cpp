#include "registration/detail/point_to_line.hpp"

#include <cmath>

namespace sketchloc::detail {

PointToLine linearize_point_to_line(std::span<const SurfacePoint> points_in_robot,
                                    const SurfaceMap& map_in_odom, const Se2& odom_from_robot,
                                    double kernel_m) {
  const Eigen::Matrix2d rotation = odom_from_robot.rotation_matrix();
  const double kernel_square = kernel_m * kernel_m;
  PointToLine sum;
  for (const SurfacePoint& surface : points_in_robot) {
    const SurfacePoint in_odom{rotation * surface.point + odom_from_robot.translation(),
                               rotation * surface.normal};
    const SurfacePoint* partner = map_in_odom.nearest(in_odom);
    if (partner == nullptr) {
      sum.cost += kernel_square;
      continue;
    }
    const double residual_m = partner->normal.dot(in_odom.point - partner->point);
    const double shrink = 1.0 / (1.0 + residual_m * residual_m / kernel_square);
    const double weight = shrink * shrink;                                  // rho' / 2 r
    const Eigen::Vector2d normal = rotation.transpose() * partner->normal;  // in robot
    // The step moves the point by (dx, dy) + dyaw * (-y, x) in the robot frame.
    const Eigen::Vector3d jacobian(normal.x(), normal.y(),
                                   normal.y() * surface.point.x() - normal.x() * surface.point.y());
    sum.information += weight * jacobian * jacobian.transpose();
    sum.half_gradient += weight * residual_m * jacobian;
    sum.cost += residual_m * residual_m * shrink;
    ++sum.partners;
    sum.close_partners += std::abs(residual_m) < kernel_m ? 1 : 0;
  }
  return sum;
}

}  // namespace sketchloc::detail

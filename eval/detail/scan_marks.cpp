#include "eval/detail/scan_marks.hpp"

namespace sketchloc::detail {

Polyline robot_outline(const Sim2& sketch_from_robot, double size_m) {
  Polyline outline = {
      {0.7 * size_m, 0.0}, {-0.4 * size_m, 0.4 * size_m}, {-0.4 * size_m, -0.4 * size_m}};
  for (Eigen::Vector2d& corner : outline) {
    corner = sketch_from_robot * corner;
  }
  return outline;
}

std::vector<Eigen::Vector2d> end_points_in_sketch(const Scan& scan, const Sim2& sketch_from_robot) {
  std::vector<Eigen::Vector2d> points = end_points_in_robot(scan);
  for (Eigen::Vector2d& point : points) {
    point = sketch_from_robot * point;
  }
  return points;
}

}  // namespace sketchloc::detail

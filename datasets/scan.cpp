#include "datasets/scan.hpp"

#include <cmath>

namespace sketchloc {

std::vector<Eigen::Vector2d> end_points_in_robot(const Scan& scan) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(scan.ranges_m.size());
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (!scan.is_return(beam)) {
      continue;
    }
    const double range_m = scan.ranges_m[beam];
    const double angle_rad = scan.angle_rad(beam);
    const Eigen::Vector2d point_in_laser(range_m * std::cos(angle_rad),
                                         range_m * std::sin(angle_rad));
    points.push_back(scan.robot_from_laser * point_in_laser);
  }
  return points;
}

}  // namespace sketchloc

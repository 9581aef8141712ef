#include "planning/nearby_obstacles.hpp"

#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

bool is_near(const Scan& scan, std::size_t beam, std::size_t other, double most_m) {
  return other < scan.ranges_m.size() && scan.is_return(other) &&
         std::abs(static_cast<double>(scan.ranges_m[beam] - scan.ranges_m[other])) <= most_m;
}

}  // namespace

void validate(const NearbyParams& params) {
  require_above("side_m", params.side_m, 0.0);
  require_above("cell_m", params.cell_m, 0.0);
  require_at_least("max_scans", params.max_scans, 1.0);
  require_above("alone_m", params.alone_m, 0.0);
}

NearbyObstacles::NearbyObstacles(const NearbyParams& params)
    : params_((validate(params), params)) {}

void NearbyObstacles::add(const Scan& scan, const Se2& odom_from_robot) {
  const Se2 odom_from_laser = odom_from_robot * scan.robot_from_laser;
  std::vector<Eigen::Vector2d> points;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const bool has_company = is_near(scan, beam, beam - 1, params_.alone_m) ||
                             is_near(scan, beam, beam + 1, params_.alone_m);
    if (scan.is_return(beam) && has_company) {
      const double angle_rad = scan.angle_rad(beam);
      points.push_back(odom_from_laser *
                       (static_cast<double>(scan.ranges_m[beam]) *
                        Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad))));
    }
  }
  points_in_odom_.push_front(std::move(points));
  if (points_in_odom_.size() > static_cast<std::size_t>(params_.max_scans)) {
    points_in_odom_.pop_back();
  }
}

Eigen::Vector2d NearbyObstacles::cells_from_robot(const Eigen::Vector2d& point_in_robot_m) const {
  return (point_in_robot_m.array() + 0.5 * params_.side_m) / params_.cell_m;
}

Eigen::Vector2d NearbyObstacles::robot_from_cells(const Eigen::Vector2d& cells) const {
  return cells.array() * params_.cell_m - 0.5 * params_.side_m;
}

Sketch NearbyObstacles::around(const Se2& odom_from_robot) const {
  const int cells = static_cast<int>(std::ceil(params_.side_m / params_.cell_m));
  Sketch window;
  window.occupied = Grid<std::uint8_t>(cells, cells);
  window.px_per_m = 1.0 / params_.cell_m;
  const Se2 robot_from_odom = odom_from_robot.inverse();
  for (const std::vector<Eigen::Vector2d>& points : points_in_odom_) {
    for (const Eigen::Vector2d& point : points) {
      const Cell cell = cell_at(cells_from_robot(robot_from_odom * point));
      if (window.occupied.contains(cell)) {
        window.occupied.at(cell) = 1;
      }
    }
  }
  return window;
}

}  // namespace sketchloc

#include "datasets/scan.hpp"

#include <cmath>

#include "motion/state_bytes.hpp"

namespace sketchloc {

namespace {

constexpr std::size_t kMostReadings = 1'000'000;

}  // namespace

void save(const Scan& scan, StateWriter& state) {
  state.put(scan.time_s);
  state.put(scan.first_angle_rad);
  state.put(scan.angle_step_rad);
  state.put(scan.min_range_m);
  state.put(scan.max_range_m);
  state.put(scan.robot_from_laser);
  state.put_list(scan.ranges_m);
}

Scan load_scan(StateReader& state) {
  Scan scan;
  scan.time_s = state.get_finite();
  scan.first_angle_rad = state.get_finite();
  scan.angle_step_rad = state.get_finite();
  scan.min_range_m = state.get_finite();
  scan.max_range_m = state.get_finite();
  scan.robot_from_laser = state.get_se2();
  scan.ranges_m = state.get_list<float>(kMostReadings);
  return scan;
}

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

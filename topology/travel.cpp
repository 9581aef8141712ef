#include "topology/travel.hpp"

#include <cmath>
#include <numbers>

#include "motion/angles.hpp"
#include "motion/check.hpp"

namespace sketchloc {

Travel travel_of(std::span<const Se2> odom_from_robot) {
  Travel travel;
  travel.way_m.reserve(odom_from_robot.size());
  travel.yaw_rad.reserve(odom_from_robot.size());
  for (std::size_t i = 0; i < odom_from_robot.size(); ++i) {
    if (i == 0) {
      travel.way_m.push_back(0.0);
      travel.yaw_rad.push_back(odom_from_robot[0].yaw_rad());
      continue;
    }
    const Se2& before = odom_from_robot[i - 1];
    const Se2& now = odom_from_robot[i];
    travel.way_m.push_back(travel.way_m.back() +
                           std::hypot(now.x_m() - before.x_m(), now.y_m() - before.y_m()));
    travel.yaw_rad.push_back(travel.yaw_rad.back() + wrap_rad(now.yaw_rad() - before.yaw_rad()));
  }
  return travel;
}

std::vector<Se2> with_headings(std::span<const Se2> odom_from_robot,
                               std::span<const double> yaw_rad) {
  check(odom_from_robot.size() == yaw_rad.size(), "one heading for each pose");
  std::vector<Se2> poses;
  poses.reserve(odom_from_robot.size());
  for (std::size_t i = 0; i < odom_from_robot.size(); ++i) {
    if (i == 0) {
      poses.push_back(
          Se2::from_xy_yaw(odom_from_robot[0].x_m(), odom_from_robot[0].y_m(), yaw_rad[0]));
      continue;
    }
    const Se2 step = odom_from_robot[i - 1].inverse() * odom_from_robot[i];
    const Se2 moved = poses.back() * step;
    poses.push_back(Se2::from_xy_yaw(moved.x_m(), moved.y_m(), yaw_rad[i]));
  }
  return poses;
}

double angle_rad(int quarter_turns) { return 0.5 * std::numbers::pi * quarter_turns; }

int nearest_quarter_turns(double angle_rad) {
  return static_cast<int>(std::lround(angle_rad / (0.5 * std::numbers::pi)));
}

}  // namespace sketchloc

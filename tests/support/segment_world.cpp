#include "tests/support/segment_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sketchloc::testing {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

World closed(const std::vector<Eigen::Vector2d>& corners) {
  World walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
  return walls;
}

/// Solves origin + way * ray = from + share * along for each wall.
double range_m(const World& world, const Eigen::Vector2d& origin, double heading_rad) {
  const Eigen::Vector2d ray(std::cos(heading_rad), std::sin(heading_rad));
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Wall& wall : world) {
    const Eigen::Vector2d along = wall.to_in_world - wall.from_in_world;
    const Eigen::Vector2d offset = wall.from_in_world - origin;
    const double way_m = cross(offset, along) / cross(ray, along);
    const double share = cross(offset, ray) / cross(ray, along);
    if (share >= 0.0 && share <= 1.0 && way_m > 0.0) {
      nearest_m = std::min(nearest_m, way_m);
    }
  }
  return nearest_m;
}

}  // namespace

World furnished_room() {
  World walls = closed({{-4, -3}, {5, -3}, {5, 4}, {-4, 4}});
  for (const World& block : {closed({{3, 1}, {4, 1}, {4, 2}, {3, 2}}),
                             closed({{-4, 0}, {-2, 0}, {-2, -0.2}, {-4, -0.2}})}) {
    walls.insert(walls.end(), block.begin(), block.end());
  }
  return walls;
}

World endless_corridor() { return {{{-200, -1}, {200, -1}}, {{-200, 1}, {200, 1}}}; }

Scan half_turn_scan() {
  Scan scan;
  scan.first_angle_rad = -std::numbers::pi / 2;
  scan.angle_step_rad = std::numbers::pi / 180;
  scan.max_range_m = 20.0;
  return scan;
}

Scan scan_from(const World& world, const Se2& world_from_robot, double noise_m, Rng& rng) {
  Scan scan = half_turn_scan();
  for (std::size_t beam = 0; beam < 181; ++beam) {
    const double heading_rad = world_from_robot.yaw_rad() + scan.angle_rad(beam);
    const double exact_m = range_m(world, world_from_robot.translation(), heading_rad);
    scan.ranges_m.push_back(static_cast<float>(exact_m + gaussian(noise_m, rng)));
  }
  return scan;
}

}  // namespace sketchloc::testing

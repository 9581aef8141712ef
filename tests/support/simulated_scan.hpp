#pragma once

#include <numbers>
#include <vector>

#include "datasets/grid.hpp"
#include "datasets/scan.hpp"
#include "motion/sim2.hpp"
#include "registration/ray_caster.hpp"

namespace sketchloc::testing {

/// What a laser that looks all around sees from a pose in a drawing of true proportions, up to the
/// middle of the lines.
inline Scan simulated_scan(const Grid<std::uint8_t>& occupied, const Sim2& sketch_from_robot,
                           std::size_t beams) {
  constexpr float kFarthest_px = 600.0F;
  Scan scan{.first_angle_rad = -std::numbers::pi,
            .angle_step_rad = 2.0 * std::numbers::pi / static_cast<double>(beams),
            .max_range_m = 30.0,
            .robot_from_laser = {},
            .ranges_m = std::vector<float>(beams)};
  std::vector<float> headings_rad(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    headings_rad[beam] = static_cast<float>(sketch_from_robot.yaw_rad() + scan.angle_rad(beam));
  }
  RayCaster(occupied).cast(sketch_from_robot.translation(), headings_rad, kFarthest_px,
                           scan.ranges_m);
  for (float& range : scan.ranges_m) {
    range = (range + 0.5F) / static_cast<float>(sketch_from_robot.scale());
  }
  return scan;
}

}  // namespace sketchloc::testing

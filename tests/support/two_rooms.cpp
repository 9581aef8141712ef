#include "tests/support/two_rooms.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "motion/random.hpp"
#include "registration/ray_caster.hpp"
#include "tests/support/similarity_registration.hpp"

namespace sketchloc::testing {

/// Two rooms of different size with a door between them, drawn in true proportions.
Sketch two_rooms() {
  Sketch sketch;
  sketch.occupied = Grid<std::uint8_t>(260, 160);
  const auto wall = [&](int left, int bottom, int right, int top) {
    for (int row = bottom; row <= top; ++row) {
      for (int column = left; column <= right; ++column) {
        sketch.occupied.at({column, row}) = 1;
      }
    }
  };
  wall(10, 10, 250, 11);
  wall(10, 150, 250, 151);
  wall(10, 10, 11, 151);
  wall(250, 10, 251, 151);
  wall(100, 10, 101, 60);  // the door is above this wall
  wall(100, 90, 101, 151);
  wall(180, 10, 181, 50);
  return sketch;
}

/// From the left room through the door into the right one; 1 cm of noise on the ranges.
Drive drive_through_the_door(const Sketch& sketch) {
  const RayCaster caster(sketch.occupied);
  Drive drive;
  Rng rng = make_rng(3);
  Sim2 sketch_from_robot = Sim2::from_xy_yaw_scale(40.0, 40.0, 0.8, kPxPerM);
  Se2 odom_from_robot;
  for (int step = 0; step < 40; ++step) {
    Scan scan;
    scan.time_s = step;
    scan.first_angle_rad = -std::numbers::pi / 2.0;
    scan.angle_step_rad = std::numbers::pi / 180.0;
    scan.max_range_m = 80.0;
    for (int beam = 0; beam <= 180; ++beam) {
      const double heading_rad =
          sketch_from_robot.yaw_rad() + scan.angle_rad(static_cast<std::size_t>(beam));
      const float range_px =
          caster.range(sketch_from_robot.translation(), static_cast<float>(heading_rad), 1e4F);
      scan.ranges_m.push_back(static_cast<float>(range_px / kPxPerM + gaussian(0.01, rng)));
    }
    drive.scans.push_back(scan);
    drive.sketch_from_robot.push_back(sketch_from_robot);
    drive.odom_from_robot.push_back(odom_from_robot);
    const Se2 robot_from_next = Se2::from_xy_yaw(0.2, 0.0, step < 20 ? -0.04 : 0.01);
    sketch_from_robot = sketch_from_robot * robot_from_next;
    odom_from_robot = odom_from_robot * robot_from_next;
  }
  return drive;
}

std::vector<std::optional<Registration>> KnowsTheWay::predict(std::span<const PlacedScan> submap,
                                                              const SketchCropper&,
                                                              std::span<const Sim2> priors) {
  const auto step = static_cast<std::size_t>(submap.front().scan->time_s);
  Registration registration = similarity_registration(drive_.sketch_from_robot[step], 0.2);
  registration.inlier_probability = 0.9;
  ++looks;
  return {priors.size(), registration};
}

}  // namespace sketchloc::testing

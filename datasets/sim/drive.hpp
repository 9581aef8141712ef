#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "datasets/sim/building.hpp"
#include "motion/random.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// How the robot is driven through a building.
struct DriveParams {
  double length_m = 120.0;       ///< the drive ends at the first goal beyond this way, > 0
  double robot_radius_m = 0.22;  ///< nothing comes nearer than this, > 0
  double scan_spacing_m = 0.4;   ///< way between scans, > 0
  double scan_turn_rad = 0.3;    ///< or turn between scans, > 0
  double speed_mps = 0.5;        ///< > 0
  double turn_rate_radps = 0.8;  ///< > 0
  double wander_m = 0.1;         ///< how far a drive strays from the planned line, >= 0
};

template <typename Visitor>
void visit_fields(DriveParams& drive, Visitor&& visit) {
  visit("length_m", drive.length_m);
  visit("robot_radius_m", drive.robot_radius_m);
  visit("scan_spacing_m", drive.scan_spacing_m);
  visit("scan_turn_rad", drive.scan_turn_rad);
  visit("speed_mps", drive.speed_mps);
  visit("turn_rate_radps", drive.turn_rate_radps);
  visit("wander_m", drive.wander_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const DriveParams& params);

/// A drive without collisions from room to room.
struct Drive {
  enum class Status {
    Driven,
    NoFreeSpace,  ///< the robot fits nowhere
    NoWay,        ///< there are other places, but no ways to them
    Confined      ///< all places that can be reached are too near to drive to
  };
  Status status = Status::NoFreeSpace;
  MetricTrajectory world_from_robot{};  ///< one pose per scan
};

/// Visits random rooms on the cheapest ways that keep off the walls. `checkpoint` is called before
/// every way; it may throw to stop the work.
Drive drive_through(const Building& building, const DriveParams& params, Rng& rng,
                    const std::function<void()>& checkpoint = {});

}  // namespace sketchloc

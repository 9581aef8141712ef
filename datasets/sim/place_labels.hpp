#pragma once

#include <vector>

#include "datasets/place_label.hpp"
#include "datasets/sim/floor_plan.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// Tells what kind of place [Topo20] a robot is at from the lines of the building: racks and walls,
/// not what lies about. Doors count as walls.
///
/// Looks from the robot along the two axes of the racks. A direction with more than 4.5 m before
/// the next rack or wall is a way. In a hall or corridor: three ways or more are an intersection; a
/// place beside the long side of a rack is rackspace, whether a rack or a wall is opposite. All
/// else is corridor, inside of rooms too. Racks are expected along the axes of the world.
class PlaceLabeller {
 public:
  explicit PlaceLabeller(const FloorPlan& plan);

  PlaceLabel label_at(const Eigen::Vector2d& point_in_world) const;
  /// One label for each pose.
  std::vector<PlaceLabel> labels(const MetricTrajectory& world_from_robot) const;

 private:
  struct Obstacle {
    PlaneBox box_in_world;
    bool rack = false;
  };

  std::vector<Obstacle> obstacles_;
  std::vector<PlaneBox> open_;  ///< halls and corridors
};

/// Whether there are racks, along the axes of the world, in a building.
bool has_racks(const FloorPlan& plan);

}  // namespace sketchloc

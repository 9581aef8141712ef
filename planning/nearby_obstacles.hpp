#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <vector>

#include "datasets/scan.hpp"
#include "datasets/sketch.hpp"
#include "motion/se2.hpp"

namespace sketchloc {

struct NearbyParams {
  double side_m = 8.0;   ///< of the square around the robot that is looked at, > 0
  double cell_m = 0.05;  ///< > 0
  int max_scans = 60;    ///< remembered, >= 1
  double alone_m = 0.3;  ///< a return with both neighbours farther off than this is noise, > 0
};

template <typename Visitor>
void visit_fields(NearbyParams& params, Visitor&& visit) {
  visit("side_m", params.side_m);
  visit("cell_m", params.cell_m);
  visit("max_scans", params.max_scans);
  visit("alone_m", params.alone_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const NearbyParams& params);

/// What the last scans saw around the robot, whether it is drawn or not.
class NearbyObstacles {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  explicit NearbyObstacles(const NearbyParams& params);

  void add(const Scan& scan, const Se2& odom_from_robot);

  /// A metric map of the square around a pose: x forward, the robot in the middle.
  Sketch around(const Se2& odom_from_robot) const;
  /// Places of that map from the robot's metres.
  Eigen::Vector2d cells_from_robot(const Eigen::Vector2d& point_in_robot_m) const;
  Eigen::Vector2d robot_from_cells(const Eigen::Vector2d& cells) const;

 private:
  NearbyParams params_;
  std::deque<std::vector<Eigen::Vector2d>> points_in_odom_;  ///< newest first
};

}  // namespace sketchloc

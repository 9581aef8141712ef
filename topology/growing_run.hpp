#pragma once

#include <vector>

#include "topology/recovered_run.hpp"

namespace sketchloc {

/// Recovers a run while it is driven. What was decided of the turns is carried on, pairs are looked
/// for where the poses are by then, and each optimization starts where the last one ended.
class GrowingRun {
 public:
  explicit GrowingRun(const TopologyParams& params = {});

  /// The next pose, and the kind of place it is at.
  void add(const Se2& odom_from_robot, PlaceLabel label);

  /// Brings everything so far together. Takes a few milliseconds for each hundred metres of way.
  const RecoveredRun& update();

  /// Where the robot is now: the newest pose of the last update and what the odometry says since.
  const Se2& manhattan_from_robot() const { return manhattan_from_robot_; }
  /// The way since the last update.
  double way_since_update_m() const { return way_since_update_m_; }

 private:
  TopologyParams params_;
  std::vector<Se2> odom_from_robot_;
  std::vector<PlaceLabel> labels_;
  std::vector<DriftTracker> trackers_;  ///< have seen the pieces that no later pose can change
  RecoveredRun run_;
  Se2 manhattan_from_robot_;
  double way_since_update_m_ = 0.0;
};

}  // namespace sketchloc

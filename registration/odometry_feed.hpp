#pragma once

#include "datasets/run.hpp"
#include "motion/state_bytes.hpp"
#include "registration/matched_odometry.hpp"

namespace sketchloc {

/// Which odometry a localizer gets.
enum class OdometrySource {
  Matched,  ///< refined by matching scans with a submap
  Raw       ///< as the wheels measured it
};

/// The odometry of a run or of a robot that drives, refined if asked for; online and causal.
class OdometryFeed {
 public:
  OdometryFeed(OdometrySource source, const MatchedOdometryParams& params)
      : source_(source), matched_(params) {}

  Se2 odom_from_robot(const RunStep& step) {
    return source_ == OdometrySource::Raw
               ? step.odom_from_robot
               : matched_.step(step.scan, step.odom_from_robot).odom_from_robot;
  }

  void save(StateWriter& state) const { matched_.save(state); }
  void load(StateReader& state) { matched_.load(state); }

 private:
  OdometrySource source_;
  MatchedOdometry matched_;
};

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "motion/se2.hpp"
#include "motion/sim2.hpp"

namespace sketchloc {

/// A pose in the drawing that the robot may have had: what a registration said.
struct PoseHypothesis {
  Sim2 sketch_from_robot;
  /// Of the pose's error e in truth = sketch_from_robot * e: (x m, y m, heading rad, log scale).
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
  double inlier_probability = 0.5;  ///< that it is right at all, in [0, 1]
};

/// Of a pose that is known with a covariance of (x px, y px, heading rad, log scale) in the sketch
/// frame.
PoseHypothesis hypothesis_of(const Sim2& sketch_from_robot,
                             const Eigen::Matrix4d& covariance_in_sketch,
                             double inlier_probability);

/// The covariance of a hypothesis in the sketch frame, as above.
Eigen::Matrix4d covariance_in_sketch(const PoseHypothesis& hypothesis);

/// One of the instants, a little way apart, at which smoothing looks.
struct Keyframe {
  std::size_t step = 0;  ///< index of the scan in the run
  double time_s = 0.0;
  Se2 odom_from_robot;
  double way_m = 0.0;                           ///< driven since the last keyframe
  double turn_rad = 0.0;                        ///< turned since then, both ways added
  std::vector<PoseHypothesis> hypotheses = {};  ///< none where nothing could be registered
};

/// Two keyframes that are beside each other by something that knows nothing of the drawing, such as
/// the topology of the building.
struct KeyframePair {
  std::size_t earlier = 0;  ///< index of a keyframe
  std::size_t later = 0;
  Se2 earlier_from_later = {};  ///< metres
  double probability = 0.5;     ///< that they are, in (0, 1)
};

/// What smoothing knows of a run.
struct KeyframeRun {
  std::optional<Sim2> start_sketch_from_robot = std::nullopt;  ///< at the first keyframe, if given
  double start_probability = 1.0;  ///< that a start that was given is right, in [0, 1]
  std::vector<Keyframe> keyframes = {};
  std::vector<KeyframePair> pairs = {};
};

}  // namespace sketchloc

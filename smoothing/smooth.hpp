#pragma once

#include <span>
#include <vector>

#include "motion/graph/optimise.hpp"
#include "motion/pose_graph.hpp"
#include "smoothing/branch.hpp"
#include "smoothing/keyframe.hpp"
#include "smoothing/smoothing_params.hpp"

namespace sketchloc {

/// Where the robot was at a keyframe, given all of them.
struct SmoothedPose {
  Sim2 sketch_from_robot;
  Eigen::Matrix4d covariance =
      Eigen::Matrix4d::Zero();  ///< of (x px, y px, heading rad, log scale), sketch frame
  /// Of the hypotheses within 2 m and 30 deg of the pose, together; of a keyframe without any, that
  /// of the nearest one with some.
  double probability = 0.0;
};

struct SmoothedRun {
  enum class Status {
    Done,
    NoEvidence  ///< no hypothesis at all: nothing says where the robot was
  };
  Status status = Status::NoEvidence;
  std::vector<SmoothedPose> poses = {};  ///< one per keyframe, if Done
};

/// The graph of a branch: a Sim(2) vertex per keyframe; odometry edges, which tie heading and scale
/// too; priors where registrations of the branch's place say that the robot was, behind a kernel;
/// the start. Where the branch jumps, odometry may be wrong.
PoseGraph branch_graph(const KeyframeRun& run, const Branch& branch, const SmoothingParams& params);

/// Decides the branch, then moves the poses along it to where everything agrees best.
SmoothedRun smooth(const KeyframeRun& run, const SmoothingParams& params = {});

/// The pose at a step, carried by odometry from the keyframes around it, each as much as it is
/// near; before the first and after the last one from that one.
Sim2 carried_pose(const KeyframeRun& run, std::span<const SmoothedPose> smoothed, std::size_t step,
                  const Se2& odom_from_robot);

/// The poses at all steps of a run.
std::vector<Sim2> carried_poses(const KeyframeRun& run, std::span<const SmoothedPose> smoothed,
                                std::span<const Se2> odom_from_robot);

}  // namespace sketchloc

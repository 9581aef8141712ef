#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "datasets/io/relations_io.hpp"
#include "eval/trajectory_errors.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// Errors against relative poses that people checked by hand.
struct RelationErrors {
  PoseErrors errors;
  std::size_t unmatched = 0;  ///< relations without a pose near one of their times
};

/// How far the odometry's motion between the two times of each relation is from the relation. The
/// mean over all relations is the measure of [Kuemmerle09]. Takes the poses nearest in time, at
/// most max_gap_s away.
RelationErrors relation_errors(const MetricTrajectory& odometry,
                               std::span<const Relation> relations, double max_gap_s);

/// What the estimate adds to each piece of the reference that is just over way_m > 0 long, from
/// every pose. Unlike relative_errors this measures the way on the reference, so that a poor and a
/// good estimate are compared on the same pieces.
PoseErrors drift_over_way(const MatchedPoses& poses, double way_m);

/// A motion with the covariance of its error d, truth = estimate * exp(d): (x m, y m, yaw rad).
struct UncertainIncrement {
  Se2 previous_from_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// NEES (3 degrees of freedom) of each increment against the reference's motion, step i from pose
/// i - 1 to pose i; step 0 is left out. The reference's increments are off themselves, by this
/// 1-sigma (x m, y m, yaw rad), which widens the covariance.
std::vector<double> increment_nees(std::span<const Se2> world_from_robot,
                                   std::span<const UncertainIncrement> increments,
                                   const Eigen::Vector3d& reference_sigma);

}  // namespace sketchloc

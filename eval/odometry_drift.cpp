#include "eval/odometry_drift.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "eval/nees.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

/// Errors of many relative motions, collected.
class ErrorList {
 public:
  void add(const Se2& truth, const Se2& estimate) {
    const Se2 error = truth.inverse() * estimate;
    translations_m_.push_back(error.translation().norm());
    rotations_rad_.push_back(std::abs(error.yaw_rad()));
  }
  PoseErrors summary() const { return {summarize(translations_m_), summarize(rotations_rad_)}; }

 private:
  std::vector<double> translations_m_;
  std::vector<double> rotations_rad_;
};

/// Index of the pose nearest in time; none farther than max_gap_s.
std::optional<std::size_t> nearest_in_time(const MetricTrajectory& trajectory, double time_s,
                                           double max_gap_s) {
  const auto after =
      std::lower_bound(trajectory.begin(), trajectory.end(), time_s,
                       [](const Stamped<Se2>& pose, double t) { return pose.time_s < t; });
  std::optional<std::size_t> nearest;
  double gap_s = max_gap_s;
  const auto consider = [&](auto pose) {
    if (std::abs(pose->time_s - time_s) <= gap_s) {
      gap_s = std::abs(pose->time_s - time_s);
      nearest = static_cast<std::size_t>(pose - trajectory.begin());
    }
  };
  if (after != trajectory.begin()) {
    consider(after - 1);
  }
  if (after != trajectory.end()) {
    consider(after);
  }
  return nearest;
}

}  // namespace

RelationErrors relation_errors(const MetricTrajectory& odometry,
                               std::span<const Relation> relations, double max_gap_s) {
  ErrorList errors;
  RelationErrors result;
  for (const Relation& relation : relations) {
    const auto first = nearest_in_time(odometry, relation.first_time_s, max_gap_s);
    const auto second = nearest_in_time(odometry, relation.second_time_s, max_gap_s);
    if (first && second && *first != *second) {
      errors.add(relation.first_from_second,
                 odometry[*first].pose.inverse() * odometry[*second].pose);
    } else {
      ++result.unmatched;
    }
  }
  result.errors = errors.summary();
  return result;
}

PoseErrors drift_over_way(const MatchedPoses& poses, double way_m) {
  check(way_m > 0.0, "drift needs a way above 0");
  const std::vector<Se2>& truth = poses.world_from_robot;
  const std::vector<Se2>& estimate = poses.estimate_from_robot;
  check(truth.size() == estimate.size(), "as many estimated as reference poses");
  ErrorList errors;
  std::size_t end = 0;
  double driven_m = 0.0;  // from `begin` to `end`
  for (std::size_t begin = 0; begin < truth.size(); ++begin) {
    while (driven_m < way_m && end + 1 < truth.size()) {
      driven_m += (truth[end + 1].translation() - truth[end].translation()).norm();
      ++end;
    }
    if (driven_m < way_m) {
      break;
    }
    errors.add(truth[begin].inverse() * truth[end], estimate[begin].inverse() * estimate[end]);
    driven_m -= (truth[begin + 1].translation() - truth[begin].translation()).norm();
  }
  return errors.summary();
}

std::vector<double> increment_nees(std::span<const Se2> world_from_robot,
                                   std::span<const UncertainIncrement> increments,
                                   const Eigen::Vector3d& reference_sigma) {
  check(world_from_robot.size() == increments.size(), "as many increments as reference poses");
  const Eigen::Matrix3d reference_covariance =
      reference_sigma.array().square().matrix().asDiagonal();
  std::vector<double> values;
  for (std::size_t i = 1; i < increments.size(); ++i) {
    const Se2 truth = world_from_robot[i - 1].inverse() * world_from_robot[i];
    const Eigen::Vector3d error = (increments[i].previous_from_robot.inverse() * truth).log();
    const auto value = nees(error, increments[i].covariance + reference_covariance);
    if (value) {
      values.push_back(*value);
    }
  }
  return values;
}

}  // namespace sketchloc

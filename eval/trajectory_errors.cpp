#include "eval/trajectory_errors.hpp"

#include <algorithm>
#include <cmath>

#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<double> times_of(const MetricTrajectory& trajectory) {
  std::vector<double> times_s;
  times_s.reserve(trajectory.size());
  std::ranges::transform(trajectory, std::back_inserter(times_s), &Stamped<Se2>::time_s);
  return times_s;
}

std::vector<Eigen::Vector2d> positions_of(std::span<const Se2> poses) {
  std::vector<Eigen::Vector2d> positions;
  positions.reserve(poses.size());
  std::ranges::transform(poses, std::back_inserter(positions), &Se2::translation);
  return positions;
}

std::optional<Sim2> alignment_of(const MatchedPoses& poses, Alignment alignment) {
  if (poses.world_from_robot.empty()) {
    return std::nullopt;
  }
  const auto world = positions_of(poses.world_from_robot);
  const auto estimate = positions_of(poses.estimate_from_robot);
  switch (alignment) {
    case Alignment::None:
      return Sim2();
    case Alignment::FirstPose:
      return Sim2::from_se2(poses.world_from_robot.front() *
                            poses.estimate_from_robot.front().inverse());
    case Alignment::Se2:
      return Sim2::from_se2(align_se2(estimate, world));
    case Alignment::Sim2:
      return align_sim2(estimate, world);
  }
  check(false, "unknown alignment");
  return std::nullopt;
}

Se2 moved(const Sim2& world_from_estimate, const Se2& estimate_from_robot) {
  const Eigen::Vector2d position = world_from_estimate * estimate_from_robot.translation();
  return Se2::from_xy_yaw(position.x(), position.y(),
                          world_from_estimate.yaw_rad() + estimate_from_robot.yaw_rad());
}

/// Way driven up to each pose.
std::vector<double> path_m(std::span<const Se2> poses) {
  std::vector<double> path(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    path[i] = path[i - 1] + (poses[i].translation() - poses[i - 1].translation()).norm();
  }
  return path;
}

IndexPairs pairs_by_frames(std::size_t count, std::size_t frames, bool all_pairs) {
  IndexPairs pairs;
  for (std::size_t i = 0; i + frames < count; i += all_pairs ? 1 : frames) {
    pairs.emplace_back(i, i + frames);
  }
  return pairs;
}

/// For each pose the later one whose way from it comes nearest to the delta, if near enough.
IndexPairs all_pairs_by_path(std::span<const double> path_m, const PathDelta& delta) {
  IndexPairs pairs;
  for (std::size_t i = 0; i + 1 < path_m.size(); ++i) {
    const double goal_m = path_m[i] + delta.path_m;
    const auto off = [&](std::size_t j) { return std::abs(path_m[j] - goal_m); };
    const auto later = path_m.subspan(i + 1);
    std::size_t best =
        i + 1 + static_cast<std::size_t>(std::ranges::lower_bound(later, goal_m) - later.begin());
    if (best == path_m.size() || (best > i + 1 && off(best - 1) <= off(best))) {
      best = i + 1 +
             static_cast<std::size_t>(  // the first of poses that stand in one place
                 std::ranges::lower_bound(later, path_m[best - 1]) - later.begin());
    }
    if (off(best) <= delta.relative_tolerance * delta.path_m) {
      pairs.emplace_back(i, best);
    }
  }
  return pairs;
}

/// Poses where the way since the last one reaches the delta; as in evo, the first is not pose 0.
IndexPairs consecutive_pairs_by_path(std::span<const double> path_m, double delta_m) {
  std::vector<std::size_t> marks;
  double since_m = 0.0;
  for (std::size_t i = 1; i < path_m.size(); ++i) {
    since_m += path_m[i] - path_m[i - 1];
    if (since_m >= delta_m) {
      marks.push_back(i);
      since_m = 0.0;
    }
  }
  IndexPairs pairs;
  for (std::size_t i = 1; i < marks.size(); ++i) {
    pairs.emplace_back(marks[i - 1], marks[i]);
  }
  return pairs;
}

PoseErrors summarize_motions(std::span<const Se2> errors) {
  std::vector<double> translation_m;
  std::vector<double> rotation_rad;
  for (const Se2& error : errors) {
    translation_m.push_back(error.translation().norm());
    rotation_rad.push_back(std::abs(error.yaw_rad()));
  }
  return {.translation_m = summarize(translation_m), .rotation_rad = summarize(rotation_rad)};
}

}  // namespace

MatchedPoses match_poses(const MetricTrajectory& reference, const MetricTrajectory& estimate,
                         double max_gap_s) {
  MatchedPoses matched;
  for (const auto& [i, j] : match_by_time(times_of(reference), times_of(estimate), max_gap_s)) {
    matched.world_from_robot.push_back(reference[i].pose);
    matched.estimate_from_robot.push_back(estimate[j].pose);
  }
  return matched;
}

std::optional<MatchedPoses> align(const MatchedPoses& poses, Alignment alignment) {
  check(poses.world_from_robot.size() == poses.estimate_from_robot.size(),
        "matched poses come in equal numbers");
  const std::optional<Sim2> world_from_estimate = alignment_of(poses, alignment);
  if (!world_from_estimate) {
    return std::nullopt;
  }
  MatchedPoses aligned = poses;
  for (Se2& estimate_from_robot : aligned.estimate_from_robot) {
    estimate_from_robot = moved(*world_from_estimate, estimate_from_robot);
  }
  return aligned;
}

PoseErrors absolute_errors(const MatchedPoses& poses) {
  std::vector<Se2> errors;
  for (std::size_t i = 0; i < poses.world_from_robot.size(); ++i) {
    errors.push_back(poses.world_from_robot[i].inverse() * poses.estimate_from_robot[i]);
  }
  return summarize_motions(errors);
}

void validate(const RelativeErrorParams& params) {
  if (const auto* by_frames = std::get_if<FrameDelta>(&params.delta)) {
    require_at_least("frames", static_cast<double>(by_frames->frames), 1.0);
  } else {
    const PathDelta& by_path = std::get<PathDelta>(params.delta);
    require_above("path_m", by_path.path_m, 0.0);
    require_at_least("relative_tolerance", by_path.relative_tolerance, 0.0);
  }
}

std::vector<std::pair<std::size_t, std::size_t>> relative_pairs(
    std::span<const Se2> estimate_from_robot, const RelativeErrorParams& params) {
  validate(params);
  if (const auto* by_frames = std::get_if<FrameDelta>(&params.delta)) {
    return pairs_by_frames(estimate_from_robot.size(), by_frames->frames, params.all_pairs);
  }
  const PathDelta& by_path = std::get<PathDelta>(params.delta);
  const std::vector<double> path = path_m(estimate_from_robot);
  return params.all_pairs ? all_pairs_by_path(path, by_path)
                          : consecutive_pairs_by_path(path, by_path.path_m);
}

PoseErrors relative_errors(const MatchedPoses& poses, const RelativeErrorParams& params) {
  std::vector<Se2> errors;
  for (const auto& [i, j] : relative_pairs(poses.estimate_from_robot, params)) {
    const Se2 reference_motion = poses.world_from_robot[i].inverse() * poses.world_from_robot[j];
    const Se2 estimate_motion =
        poses.estimate_from_robot[i].inverse() * poses.estimate_from_robot[j];
    errors.push_back(reference_motion.inverse() * estimate_motion);
  }
  return summarize_motions(errors);
}

}  // namespace sketchloc

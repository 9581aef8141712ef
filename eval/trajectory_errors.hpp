#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "eval/summary.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// Poses of a reference and of an estimate at the same instants, equally many.
struct MatchedPoses {
  std::vector<Se2> world_from_robot;     ///< reference
  std::vector<Se2> estimate_from_robot;  ///< estimate, in its own metric frame
};

/// Pairs poses nearest in time, at most max_gap_s apart (evo's default: 0.01 s), each used once.
MatchedPoses match_poses(const MetricTrajectory& reference, const MetricTrajectory& estimate,
                         double max_gap_s = 0.01);

/// How the estimate's frame is laid onto the reference's before errors are taken.
enum class Alignment {
  None,       ///< as they are (evo: no flag)
  FirstPose,  ///< first poses coincide (evo: --align_origin)
  Se2,        ///< least squares of the positions, rigid (evo: --align)
  Sim2        ///< least squares of the positions, with scale (evo: --align --correct_scale)
};

/// The estimate in the reference's frame; none where there is nothing to align (no poses, or
/// Sim2 with all positions in one place). A scale moves positions only.
std::optional<MatchedPoses> align(const MatchedPoses& poses, Alignment alignment);

/// Errors of poses; the summaries are none where there was no pair.
struct PoseErrors {
  std::optional<ErrorSummary> translation_m;
  std::optional<ErrorSummary> rotation_rad;
};

/// Absolute trajectory error of aligned poses: distance of the positions (evo_ape's
/// `trans_part`), angle of the rotation between them (`angle_rad`). [Sturm12]
PoseErrors absolute_errors(const MatchedPoses& poses);

/// Relative pose error over this many poses.
struct FrameDelta {
  std::size_t frames = 1;  ///< >= 1
};

/// Relative pose error over this much of the way.
struct PathDelta {
  double path_m = 1.0;              ///< > 0
  double relative_tolerance = 0.1;  ///< of path_m; all pairs only, >= 0
};

struct RelativeErrorParams {
  std::variant<FrameDelta, PathDelta> delta;
  bool all_pairs = true;  ///< false: only pairs that follow each other, as evo does by default
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const RelativeErrorParams& params);

/// Relative pose error: what the estimate adds to the reference's motion between the two poses of
/// each pair. Pairs are chosen on the estimate, as evo_rpe does. [Sturm12]
PoseErrors relative_errors(const MatchedPoses& poses, const RelativeErrorParams& params);

/// The index pairs that relative_errors compares.
std::vector<std::pair<std::size_t, std::size_t>> relative_pairs(
    std::span<const Se2> estimate_from_robot, const RelativeErrorParams& params);

}  // namespace sketchloc

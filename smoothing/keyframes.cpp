#include "smoothing/keyframes.hpp"

#include <cmath>

#include "motion/check.hpp"
#include "motion/odometry.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

bool saw_anything(const Scan& scan) {
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (scan.is_return(beam)) {
      return true;
    }
  }
  return false;
}

/// Scans of one side of a step, the nearest first, a little way or turn apart.
std::vector<PlacedScan> one_side(std::span<const RunStep> steps, std::size_t step, bool is_before,
                                 const RecentScansParams& params) {
  std::vector<PlacedScan> scans;
  double way_m = 0.0;
  double turn_rad = 0.0;
  std::size_t at = step;
  while (scans.size() + 1 < static_cast<std::size_t>(params.max_scans) &&
         (is_before ? at > 0 : at + 1 < steps.size())) {
    const std::size_t next = is_before ? at - 1 : at + 1;
    const Se2 moved = odometry_increment(steps[at].odom_from_robot, steps[next].odom_from_robot);
    way_m += moved.translation().norm();
    turn_rad += std::abs(moved.yaw_rad());
    at = next;
    if ((way_m >= params.spacing_m || turn_rad >= params.max_turn_rad) &&
        saw_anything(steps[at].scan)) {
      scans.push_back(
          {.scan = &steps[at].scan,
           .robot_from_then = steps[step].odom_from_robot.inverse() * steps[at].odom_from_robot});
      way_m = 0.0;
      turn_rad = 0.0;
    }
  }
  return scans;
}

}  // namespace

void validate(const KeyframeParams& params) {
  require_above("way_m", params.way_m, 0.0);
  require_above("turn_rad", params.turn_rad, 0.0);
  validate_part("submap", params.submap);
}

std::vector<PlacedScan> submap_around(std::span<const RunStep> steps, std::size_t step,
                                      Around which, const RecentScansParams& params) {
  check(step < steps.size(), "a step of the run");
  if (!saw_anything(steps[step].scan)) {
    return {};
  }
  using Scans = std::vector<PlacedScan>;
  const Scans before = which == Around::After ? Scans() : one_side(steps, step, true, params);
  const Scans after = which == Around::Before ? Scans() : one_side(steps, step, false, params);
  Scans scans = {{.scan = &steps[step].scan}};
  for (std::size_t i = 0; i < std::max(before.size(), after.size()); ++i) {
    for (const Scans* side : {&before, &after}) {
      if (i < side->size()) {
        scans.push_back((*side)[i]);
      }
    }
  }
  return scans;
}

std::vector<PoseHypothesis> register_at(std::span<const PlacedScan> submap,
                                        const SketchCropper& drawing, WarpPredictor& predictor,
                                        std::span<const Sim2> priors_sketch_from_robot) {
  std::vector<PoseHypothesis> hypotheses;
  if (submap.empty() || priors_sketch_from_robot.empty()) {
    return hypotheses;
  }
  for (const auto& found : predictor.predict(submap, drawing, priors_sketch_from_robot)) {
    if (found && found->covariance && found->covariance->allFinite()) {
      hypotheses.push_back({.sketch_from_robot = found->sketch_from_robot,
                            .covariance = *found->covariance,
                            .inlier_probability = found->inlier_probability});
    }
  }
  return hypotheses;
}

}  // namespace sketchloc

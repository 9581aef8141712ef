#pragma once

#include <Eigen/Core>

#include "motion/graph/kernel.hpp"

namespace sketchloc {

/// How the place in a drawing departs from the metres driven between two keyframes: 1-sigma after
/// one metre, growing with the square root of the way. The drawing's deformation varies slowly over
/// space, so heading and scale are tied from keyframe to keyframe. Chosen on simulated drives, see
/// docs/results/smoothing.md.
struct DrawingWalk {
  double length_m = 0.3;           ///< along the way, > 0
  double shear_m = 0.25;           ///< across the way, > 0
  double heading_rad = 0.07;       ///< of the local rotation, > 0
  double log_scale = 0.12;         ///< of the local log scale, > 0
  double turn_rad_per_rad = 0.03;  ///< of the odometry's heading, >= 0
};

template <typename Visitor>
void visit_fields(DrawingWalk& walk, Visitor&& visit) {
  visit("length_m", walk.length_m);
  visit("shear_m", walk.shear_m);
  visit("heading_rad", walk.heading_rad);
  visit("log_scale", walk.log_scale);
  visit("turn_rad_per_rad", walk.turn_rad_per_rad);
}

void validate(const DrawingWalk& walk);

/// Covariance of (x m, y m, heading rad, log scale) between two poses in a drawing, this way and
/// turn apart.
Eigen::Matrix4d walk_covariance(const DrawingWalk& walk, double way_m, double turn_rad);

struct SmoothingParams {
  DrawingWalk walk{};
  double start_position_m = 0.5;   ///< 1-sigma of a start that was given, > 0
  double start_heading_rad = 0.1;  ///< > 0
  double start_log_scale = 0.15;   ///< > 0
  double jump_log_odds = -8.0;     ///< of the branch leaving for any other hypothesis, < 0
  /// How much of a registration is evidence that the others of a keyframe do not give: they look at
  /// the same scans, in (0, 1].
  double independent_share = 0.33;
  double max_probability = 0.95;  ///< no registration is righter than this, in [0.5, 1)
  double certainty = 0.5;         ///< of what is stated: how much of the evidence counts, in (0, 1]
  double lost_way_m = 108.0;      ///< mean way from a hypothesis that is right to none, > 0
  double found_way_m = 50.0;      ///< and back, > 0
  double start_elsewhere = 0.97;  ///< that none is right at the beginning without a start, [0, 1]
  double min_position_m = 0.05;   ///< what no registration tells, 1-sigma, > 0
  double min_heading_rad = 0.02;  ///< > 0
  double min_log_scale = 0.02;    ///< > 0
  double pair_position_m = 0.4;   ///< of the places of a pair, 1-sigma, > 0
  double pair_heading_rad = 0.1;  ///< > 0
  double pair_log_scale = 0.15;   ///< > 0
  int pair_rounds = 3;  ///< of telling both keyframes of a pair what the other knows, >= 0
  RobustKernel kernel{.shape = KernelShape::Dcs, .width = 1.7};  ///< of registrations
};

template <typename Visitor>
void visit_fields(SmoothingParams& params, Visitor&& visit) {
  visit("walk", params.walk);
  visit("start_position_m", params.start_position_m);
  visit("start_heading_rad", params.start_heading_rad);
  visit("start_log_scale", params.start_log_scale);
  visit("jump_log_odds", params.jump_log_odds);
  visit("independent_share", params.independent_share);
  visit("max_probability", params.max_probability);
  visit("certainty", params.certainty);
  visit("lost_way_m", params.lost_way_m);
  visit("found_way_m", params.found_way_m);
  visit("start_elsewhere", params.start_elsewhere);
  visit("min_position_m", params.min_position_m);
  visit("min_heading_rad", params.min_heading_rad);
  visit("min_log_scale", params.min_log_scale);
  visit("pair_position_m", params.pair_position_m);
  visit("pair_heading_rad", params.pair_heading_rad);
  visit("pair_log_scale", params.pair_log_scale);
  visit("pair_rounds", params.pair_rounds);
  visit("kernel", params.kernel);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const SmoothingParams& params);

/// Covariance of (x m, y m, heading rad, log scale) between the places of a pair.
Eigen::Matrix4d pair_covariance(const SmoothingParams& params);

/// Covariance of (x m, y m, heading rad, log scale) of a start that was given.
Eigen::Matrix4d start_covariance(const SmoothingParams& params);

}  // namespace sketchloc

#pragma once

#include <span>
#include <vector>

#include "motion/pose_graph.hpp"
#include "topology/heading_drift.hpp"
#include "topology/same_place.hpp"

namespace sketchloc {

/// How sure the edges of a recovered trajectory are.
struct RunGraphParams {
  double step_sigma_m =
      0.01;  ///< position error after a metre, grows with the root of the way, > 0
  double least_sigma_m = 0.002;   ///< of a step, > 0
  double least_sigma_deg = 0.02;  ///< of a step, > 0
  double pass_sigma_m = 0.2;      ///< across, between two passes of one place, > 0
};
void validate(const RunGraphParams& params);

template <typename Visitor>
void visit_fields(RunGraphParams& params, Visitor&& visit) {
  visit("step_sigma_m", params.step_sigma_m);
  visit("least_sigma_m", params.least_sigma_m);
  visit("least_sigma_deg", params.least_sigma_deg);
  visit("pass_sigma_m", params.pass_sigma_m);
}

/// What is known of a run's headings.
struct HeadingEvidence {
  Travel travel = {};
  std::vector<StraightPiece> pieces = {};
  std::vector<PieceHeading> headings = {};  ///< of the pieces
  std::vector<double> drift_rad = {};       ///< of the poses
  DriftParams drift = {};                   ///< how good the odometry turned out to be
};

/// Every pose a vertex; the steps of the odometry without its drift as edges, the axis of every
/// straight piece as a prior of one heading. The first position stays, and without a straight piece
/// the first heading too.
PoseGraph run_graph(std::span<const Se2> odom_from_robot, const HeadingEvidence& evidence,
                    const RunGraphParams& params);

/// Adds a pair: no offset across its axis, told by one edge between its typical poses, since a
/// robust kernel sees a pair that is wrong as one edge that is far off.
void tie_together(PoseGraph& graph, const SamePlacePair& pair, const RunGraphParams& params);

}  // namespace sketchloc

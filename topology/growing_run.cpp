#include "topology/growing_run.hpp"

#include <utility>

#include "motion/check.hpp"
#include "topology/detail/recovery_steps.hpp"

namespace sketchloc {
namespace {

void add_to_all(std::vector<DriftTracker>& trackers, const StraightPiece& piece) {
  for (DriftTracker& tracker : trackers) {
    tracker.add(piece);
  }
}

}  // namespace

GrowingRun::GrowingRun(const TopologyParams& params)
    : params_(params), trackers_(drift_trackers(params.drift)) {
  validate(params);
}

void GrowingRun::add(const Se2& odom_from_robot, PlaceLabel label) {
  if (odom_from_robot_.empty()) {
    manhattan_from_robot_ = odom_from_robot;
  } else {
    const Se2 step = odom_from_robot_.back().inverse() * odom_from_robot;
    manhattan_from_robot_ = manhattan_from_robot_ * step;
    way_since_update_m_ += step.translation().norm();
  }
  odom_from_robot_.push_back(odom_from_robot);
  labels_.push_back(label);
}

const RecoveredRun& GrowingRun::update() {
  check(!odom_from_robot_.empty(), "a run of at least one pose");
  HeadingEvidence evidence{.travel = travel_of(odom_from_robot_)};
  evidence.pieces = straight_pieces(odom_from_robot_, evidence.travel, params_.straight);
  // A piece is what it is once the robot is a window beyond it.
  const double settled_m = evidence.travel.way_m.back() - params_.straight.window_m;
  std::vector<DriftTracker> trackers = trackers_;
  for (std::size_t i = trackers_.front().pieces(); i < evidence.pieces.size(); ++i) {
    const StraightPiece& piece = evidence.pieces[i];
    add_to_all(trackers, piece);
    if (evidence.travel.way_m[piece.last] < settled_m) {
      add_to_all(trackers_, piece);
    }
  }
  detail::decide_headings(evidence, likeliest(trackers));
  run_.evidence = std::move(evidence);
  run_.nodes = topological_nodes(run_.evidence.travel, labels_, params_.nodes);
  const detail::BareRun bare{run_graph(odom_from_robot_, run_.evidence, params_.graph)};
  // Nodes only come and grow: the pairs of the last update stay what they were.
  detail::optimise_with(run_, bare, run_.pairs, params_);
  detail::optimise_with(run_, bare,
                        same_places(run_.manhattan_from_robot, run_.evidence.travel, run_.nodes,
                                    params_.same_place, params_.same_place.possible),
                        params_);
  manhattan_from_robot_ = run_.manhattan_from_robot.back();
  way_since_update_m_ = 0.0;
  return run_;
}

}  // namespace sketchloc

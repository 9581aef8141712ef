#include "topology/recovered_run.hpp"

#include <algorithm>
#include <array>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "topology/detail/recovery_steps.hpp"

namespace sketchloc {
namespace {

constexpr std::array<std::pair<std::string_view, TopologyStage>, 6> kStages = {
    {{"unoptimised", TopologyStage::Unoptimised},
     {"snap", TopologyStage::Snap},
     {"manhattan", TopologyStage::Manhattan},
     {"loops", TopologyStage::Loops},
     {"dense", TopologyStage::Dense},
     {"feedback", TopologyStage::Feedback}}};

HeadingEvidence heading_evidence(std::span<const Se2> odom_from_robot,
                                 const TopologyParams& params) {
  HeadingEvidence evidence{.travel = travel_of(odom_from_robot)};
  evidence.pieces = straight_pieces(odom_from_robot, evidence.travel, params.straight);
  std::vector<DriftTracker> trackers = drift_trackers(params.drift);
  for (DriftTracker& tracker : trackers) {
    for (const StraightPiece& piece : evidence.pieces) {
      tracker.add(piece);
    }
  }
  detail::decide_headings(evidence, likeliest(trackers));
  return evidence;
}

std::vector<Se2> snapped(std::span<const Se2> odom_from_robot, const HeadingEvidence& evidence) {
  const std::vector<double> drift_rad =
      snapped_drift_at_poses(evidence.travel, evidence.pieces, evidence.headings);
  std::vector<double> yaw_rad = evidence.travel.yaw_rad;
  for (std::size_t i = 0; i < yaw_rad.size(); ++i) {
    yaw_rad[i] -= drift_rad[i];
  }
  return with_headings(odom_from_robot, yaw_rad);
}

bool same_pairs(const std::vector<SamePlacePair>& a, const std::vector<SamePlacePair>& b) {
  return std::ranges::equal(a, b, [](const SamePlacePair& p, const SamePlacePair& q) {
    return p.earlier == q.earlier && p.later == q.later;
  });
}

void close_loops(RecoveredRun& run, const detail::BareRun& bare, const TopologyParams& params,
                 TopologyStage stage) {
  const auto proposed = [&](double least_probability) {
    return same_places(run.manhattan_from_robot, run.evidence.travel, run.nodes, params.same_place,
                       least_probability);
  };
  detail::optimise_with(run, bare, proposed(params.same_place.confident), params);
  if (stage == TopologyStage::Loops) {
    return;
  }
  const int rounds = stage == TopologyStage::Feedback ? params.most_rounds : 1;
  for (int round = 0; round < rounds; ++round) {
    std::vector<SamePlacePair> pairs = proposed(params.same_place.possible);
    if (same_pairs(pairs, run.pairs)) {
      return;
    }
    detail::optimise_with(run, bare, std::move(pairs), params);
  }
}

}  // namespace

std::span<const std::pair<std::string_view, TopologyStage>> names_of(TopologyStage) {
  return kStages;
}

void validate(const TopologyParams& params) {
  validate_part("straight", params.straight);
  validate_part("drift", params.drift);
  validate_part("nodes", params.nodes);
  validate_part("same_place", params.same_place);
  validate_part("graph", params.graph);
  validate_part("closure", params.closure);
  validate_part("kernel", params.kernel);
  require_in_range("most_rounds", params.most_rounds, 1.0, 1000.0);
  require_at_least("update_m", params.update_m, 0.0);
}

TopologyParams matched_topology_params() {
  TopologyParams params;
  params.drift.wander_deg = 0.05;
  params.drift.turn_error_deg = 0.2;
  params.drift.slope_deg_per_m = 0.05;
  params.drift.slope_walk_deg = 0.002;
  params.graph.step_sigma_m = 0.005;
  params.graph.least_sigma_m = 0.001;
  params.graph.least_sigma_deg = 0.01;
  return params;
}

RecoveredRun recover_run(std::span<const Se2> odom_from_robot, std::span<const PlaceLabel> labels,
                         const TopologyParams& params, TopologyStage stage,
                         std::span<const Scan> scans) {
  validate(params);
  check(odom_from_robot.size() == labels.size(), "one label for each pose");
  check(scans.empty() || scans.size() == labels.size(), "one scan for each pose, or none");
  RecoveredRun run{.evidence = heading_evidence(odom_from_robot, params)};
  run.nodes = topological_nodes(run.evidence.travel, labels, params.nodes);
  run.manhattan_from_robot.assign(odom_from_robot.begin(), odom_from_robot.end());
  if (odom_from_robot.empty() || stage == TopologyStage::Unoptimised) {
    return run;
  }
  if (stage == TopologyStage::Snap) {
    run.manhattan_from_robot = snapped(odom_from_robot, run.evidence);
    return run;
  }
  const detail::BareRun bare{.graph = run_graph(odom_from_robot, run.evidence, params.graph),
                             .scans = scans};
  detail::optimise_with(run, bare, {}, params);
  if (stage != TopologyStage::Manhattan) {
    close_loops(run, bare, params, stage);
  }
  return run;
}

}  // namespace sketchloc

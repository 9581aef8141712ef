#include "topology/detail/recovery_steps.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

namespace sketchloc::detail {

void decide_headings(HeadingEvidence& evidence, const DriftTracker& tracker) {
  evidence.drift = tracker.params();
  evidence.headings = tracker.headings();
  evidence.drift_rad = drift_at_poses(evidence.travel, evidence.pieces, evidence.headings);
}

namespace {

/// The bare graph, from the last optimum on.
PoseGraph carried_on(const RecoveredRun& run, const PoseGraph& bare) {
  PoseGraph graph = bare;
  const std::vector<GraphPose>& known = run.result.poses;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    GraphPose& pose = graph.vertices[i].frame_from_body;
    if (i < known.size()) {
      pose = known[i];
    } else if (!known.empty()) {
      pose = compose(graph.vertices[i - 1].frame_from_body,
                     between(bare.vertices[i - 1].frame_from_body, pose));
    }
  }
  return graph;
}

/// By their scans where these fit, else by what a pair says alone.
void tie_pairs(RecoveredRun& run, std::span<const Scan> scans, const TopologyParams& params) {
  const SeenRun seen{.scans = scans,
                     .manhattan_from_robot = run.manhattan_from_robot,
                     .travel = run.evidence.travel};
  run.closures = 0;
  for (const SamePlacePair& pair : run.pairs) {
    std::optional<GraphEdge> closure;
    if (!scans.empty()) {
      closure = close_by_scans(seen, pair, params.closure);
    }
    if (closure) {
      run.graph.edges.push_back(*closure);
      ++run.closures;
    } else {
      tie_together(run.graph, pair, params.graph);
    }
  }
}

}  // namespace

void optimise_with(RecoveredRun& run, const BareRun& bare, std::vector<SamePlacePair> pairs,
                   const TopologyParams& params) {
  run.pairs = std::move(pairs);
  run.graph = carried_on(run, bare.graph);
  tie_pairs(run, bare.scans, params);
  run.result = optimise(run.graph, {.kernel = params.kernel, .initial = GraphStart::Given});
  run.graph = with_poses(std::move(run.graph), run.result.poses);
  run.manhattan_from_robot.clear();
  std::ranges::transform(run.result.poses, std::back_inserter(run.manhattan_from_robot), to_se2);
  ++run.rounds;
}

}  // namespace sketchloc::detail

#include "topology/detail/recovery_steps.hpp"

#include <algorithm>
#include <iterator>

namespace sketchloc::detail {

void decide_headings(HeadingEvidence& evidence, const DriftTracker& tracker) {
  evidence.drift = tracker.params();
  evidence.headings = tracker.headings();
  evidence.drift_rad = drift_at_poses(evidence.travel, evidence.pieces, evidence.headings);
}

void optimise_with(RecoveredRun& run, const PoseGraph& bare, std::vector<SamePlacePair> pairs,
                   const TopologyParams& params) {
  run.pairs = std::move(pairs);
  run.graph = bare;
  const std::vector<GraphPose> known = run.result.poses;
  for (std::size_t i = 0; i < run.graph.vertices.size(); ++i) {
    GraphPose& pose = run.graph.vertices[i].frame_from_body;
    if (i < known.size()) {
      pose = known[i];
    } else if (!known.empty()) {
      pose = compose(run.graph.vertices[i - 1].frame_from_body,
                     between(bare.vertices[i - 1].frame_from_body, pose));
    }
  }
  for (const SamePlacePair& pair : run.pairs) {
    tie_together(run.graph, pair, params.graph);
  }
  run.result = optimise(run.graph, {.kernel = params.kernel, .initial = GraphStart::Given});
  run.graph = with_poses(std::move(run.graph), run.result.poses);
  run.manhattan_from_robot.clear();
  std::ranges::transform(run.result.poses, std::back_inserter(run.manhattan_from_robot), to_se2);
  ++run.rounds;
}

}  // namespace sketchloc::detail

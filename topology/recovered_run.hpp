#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/place_label.hpp"
#include "motion/graph/optimise.hpp"
#include "topology/heading_drift.hpp"
#include "topology/run_graph.hpp"
#include "topology/same_place.hpp"
#include "topology/scan_closure.hpp"
#include "topology/straight_pieces.hpp"
#include "topology/topological_nodes.hpp"

namespace sketchloc {

/// How much of the topology is used, each stage with those before. [Topo20, Table IV]
enum class TopologyStage {
  Unoptimised,  ///< the odometry
  Snap,         ///< every straight piece turned onto its wall; nothing is optimized
  Manhattan,    ///< headings by turns that were decided jointly
  Loops,        ///< and pairs of places that are surely the same
  Dense,        ///< and pairs that are possibly the same, behind a robust kernel
  Feedback,     ///< and pairs looked for again where the poses are now, until none changes
};
std::span<const std::pair<std::string_view, TopologyStage>> names_of(TopologyStage);

struct TopologyParams {
  StraightParams straight = {};
  DriftParams drift = {};
  NodeParams nodes = {};
  SamePlaceParams same_place = {};
  RunGraphParams graph = {};
  ScanClosureParams closure = {};
  RobustKernel kernel = {.shape = KernelShape::Dcs, .width = 1.0};  ///< of pairs
  int most_rounds = 6;                                              ///< of the feedback, > 0
  double update_m = 5.0;  ///< of way between two updates of a run that grows, >= 0
};
void validate(const TopologyParams& params);

template <typename Visitor>
void visit_fields(TopologyParams& params, Visitor&& visit) {
  visit("straight", params.straight);
  visit("drift", params.drift);
  visit("nodes", params.nodes);
  visit("same_place", params.same_place);
  visit("graph", params.graph);
  visit("closure", params.closure);
  visit("kernel", params.kernel);
  visit("most_rounds", params.most_rounds);
  visit("update_m", params.update_m);
}

/// The parameters for odometry that was refined by matching scans
/// (registration/matched_odometry.hpp).
TopologyParams matched_topology_params();

/// A trajectory brought back by what is known of buildings with right angles.
struct RecoveredRun {
  std::vector<Se2> manhattan_from_robot = {};  ///< axes along the walls, near the odometry's
  HeadingEvidence evidence = {};
  std::vector<TopologicalNode> nodes = {};
  std::vector<SamePlacePair> pairs = {};  ///< those that were used
  PoseGraph graph = {};                   ///< at the optimum; empty where nothing was optimized
  OptimiseResult result = {};
  int rounds = 0;            ///< optimizations
  std::size_t closures = 0;  ///< pairs whose passes were laid onto each other by their scans
};

/// Recovers a run from its odometry and the kind of place it was at, pose by pose. In a drive
/// without straight pieces, or in no Manhattan-like building, little is gained. With scans, pairs
/// are closed by these where they fit. Poses, labels and scans, if there are any: equally many.
/// Throws std::invalid_argument for parameters out of range.
RecoveredRun recover_run(std::span<const Se2> odom_from_robot, std::span<const PlaceLabel> labels,
                         const TopologyParams& params = {},
                         TopologyStage stage = TopologyStage::Feedback,
                         std::span<const Scan> scans = {});

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "datasets/place_label.hpp"
#include "topology/travel.hpp"

namespace sketchloc {

/// When poses of one label are a place of their own. [Topo20]
struct NodeParams {
  double shortest_m = 0.3;    ///< of a node; shorter ones are noise of the labels, > 0
  double most_turn_deg = 45;  ///< within a node: beyond it a new one begins, 10 to 90
};
void validate(const NodeParams& params);

template <typename Visitor>
void visit_fields(NodeParams& params, Visitor&& visit) {
  visit("shortest_m", params.shortest_m);
  visit("most_turn_deg", params.most_turn_deg);
}

/// A run of poses of one label without a turn: a node of the topological graph. Consecutive nodes
/// are its edges.
struct TopologicalNode {
  std::size_t first = 0;  ///< pose
  std::size_t last = 0;   ///< pose, included
  PlaceLabel label = PlaceLabel::Rackspace;
  double length_m = 0.0;  ///< of the way
};

/// In the order of the way. Poses between them belong to none.
std::vector<TopologicalNode> topological_nodes(const Travel& travel,
                                               std::span<const PlaceLabel> labels,
                                               const NodeParams& params = {});

}  // namespace sketchloc

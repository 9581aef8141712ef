#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "motion/se2.hpp"
#include "topology/topological_nodes.hpp"

namespace sketchloc {

/// What tells whether two nodes beside each other are the same place.
enum class PlaceComparison {
  Geometry,  ///< how far they are apart, against what passes and aisles are
  Siamese    ///< the comparator of [Topo20], see place_comparator.hpp
};
std::span<const std::pair<std::string_view, PlaceComparison>> names_of(PlaceComparison);

/// When two nodes are the same place.
struct SamePlaceParams {
  PlaceComparison comparison = PlaceComparison::Geometry;
  double shortest_m = 0.3;       ///< of what two nodes share along their axis, > 0
  double overlap_share = 0.25;   ///< of the shorter node that must lie beside the other, in (0, 1]
  double most_skew_deg = 25.0;   ///< of a node against the walls; others are not compared, 1 to 45
  double pass_sigma_m = 0.45;    ///< across, between two passes of one place, > 0
  double aisle_spacing_m = 2.5;  ///< across, to the next place that looks the same, > 0
  double confident = 0.8;        ///< probability from which a pair is taken without asking, (0, 1)
  double possible = 0.4;         ///< from which it is proposed, to be judged with others, (0, 1)
};
void validate(const SamePlaceParams& params);

template <typename Visitor>
void visit_fields(SamePlaceParams& params, Visitor&& visit) {
  visit("comparison", params.comparison);
  visit("shortest_m", params.shortest_m);
  visit("overlap_share", params.overlap_share);
  visit("most_skew_deg", params.most_skew_deg);
  visit("pass_sigma_m", params.pass_sigma_m);
  visit("aisle_spacing_m", params.aisle_spacing_m);
  visit("confident", params.confident);
  visit("possible", params.possible);
}

/// Two poses side by side.
struct PosesBeside {
  std::size_t earlier = 0;  ///< pose of the earlier node
  std::size_t later = 0;    ///< pose of the later node
  double across_m = 0.0;    ///< from the one to the other, across their axis, where they lie now
};

/// Two nodes that may be one place.
struct SamePlacePair {
  std::size_t earlier = 0;   ///< node
  std::size_t later = 0;     ///< node
  double probability = 0.0;  ///< that they are the same
  double across_m = 0.0;     ///< median distance across their axis, where they lie now
  /// From one end of what the nodes share to the other.
  std::vector<PosesBeside> beside = {};
};

/// The two poses whose distance across is the median: a robot that wobbles between racks is nowhere
/// else as typical. The pair has some.
PosesBeside typical(const SamePlacePair& pair);

/// All pairs of nodes of one label, one axis and a shared stretch whose probability is at least
/// `least_probability`. Two passes of one place lie `pass_sigma_m` apart, other places anywhere
/// within an aisle's spacing: what is known of labels alone. The comparator's probability is 1
/// minus the distance at which it puts two nodes. Poses are in the Manhattan frame.
std::vector<SamePlacePair> same_places(std::span<const Se2> manhattan_from_robot,
                                       const Travel& travel, std::span<const TopologicalNode> nodes,
                                       const SamePlaceParams& params, double least_probability);

}  // namespace sketchloc

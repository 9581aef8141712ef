#include "topology/topological_nodes.hpp"

#include <cmath>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {

void validate(const NodeParams& params) {
  require_above("shortest_m", params.shortest_m, 0.0);
  require_in_range("most_turn_deg", params.most_turn_deg, 10.0, 90.0);
}

std::vector<TopologicalNode> topological_nodes(const Travel& travel,
                                               std::span<const PlaceLabel> labels,
                                               const NodeParams& params) {
  validate(params);
  check(labels.size() == travel.way_m.size(), "one label for each pose");
  const double most_turn_rad = rad_from_deg(params.most_turn_deg);
  std::vector<TopologicalNode> nodes;
  std::size_t next = 0;
  for (std::size_t first = 0; first < labels.size(); first = next) {
    next = first + 1;
    while (next < labels.size() && labels[next] == labels[first] &&
           std::abs(travel.yaw_rad[next] - travel.yaw_rad[first]) < most_turn_rad) {
      ++next;
    }
    const double length_m = travel.way_m[next - 1] - travel.way_m[first];
    if (length_m >= params.shortest_m) {
      nodes.push_back(
          {.first = first, .last = next - 1, .label = labels[first], .length_m = length_m});
    }
  }
  return nodes;
}

}  // namespace sketchloc

#include "topology/same_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/quantile.hpp"
#include "motion/validate.hpp"
#include "registration/shipped_networks.hpp"
#include "topology/place_comparator.hpp"

namespace sketchloc {
namespace {

/// Poses beside each other are looked at this far apart.
constexpr double kSpacing_m = 1.0;

/// A node as it lies along an axis of the Manhattan frame.
struct AxisNode {
  int along = 0;  ///< 0: x, 1: y
  double low_m = 0.0;
  double high_m = 0.0;
};

/// None for nodes that keep to no axis.
std::optional<AxisNode> axis_node(std::span<const Se2> poses, const TopologicalNode& node,
                                  const SamePlaceParams& params) {
  const Eigen::Vector2d chord = poses[node.last].translation() - poses[node.first].translation();
  const double direction_rad = std::atan2(chord.y(), chord.x());
  const int quarter_turns = nearest_quarter_turns(direction_rad);
  if (std::abs(direction_rad - angle_rad(quarter_turns)) > rad_from_deg(params.most_skew_deg)) {
    return std::nullopt;
  }
  AxisNode axis{.along = std::abs(quarter_turns) % 2};
  axis.low_m = axis.high_m = poses[node.first].translation()[axis.along];
  for (std::size_t i = node.first; i <= node.last; ++i) {
    axis.low_m = std::min(axis.low_m, poses[i].translation()[axis.along]);
    axis.high_m = std::max(axis.high_m, poses[i].translation()[axis.along]);
  }
  return axis;
}

std::size_t nearest_pose(std::span<const Se2> poses, const TopologicalNode& node, int along,
                         double at_m) {
  std::size_t nearest = node.first;
  for (std::size_t i = node.first; i <= node.last; ++i) {
    if (std::abs(poses[i].translation()[along] - at_m) <
        std::abs(poses[nearest].translation()[along] - at_m)) {
      nearest = i;
    }
  }
  return nearest;
}

/// Normal density of what two passes of one place are apart, against the flat one of other places.
double probability_of(double across_m, const SamePlaceParams& params) {
  const double z = across_m / params.pass_sigma_m;
  const double same =
      std::exp(-0.5 * z * z) / (params.pass_sigma_m * std::sqrt(2.0 * std::numbers::pi));
  const double other = 0.5 / params.aisle_spacing_m;
  return same / (same + other);
}

constexpr std::array<std::pair<std::string_view, PlaceComparison>, 2> kComparisons = {
    {{"geometry", PlaceComparison::Geometry}, {"siamese", PlaceComparison::Siamese}}};

struct Compared {
  std::span<const Se2> poses;
  const SamePlaceParams& params;
};

std::optional<SamePlacePair> compared(const Compared& context, const TopologicalNode& earlier,
                                      const AxisNode& a, const TopologicalNode& later,
                                      const AxisNode& b) {
  const double low_m = std::max(a.low_m, b.low_m);
  const double high_m = std::min(a.high_m, b.high_m);
  const double shorter_m = std::min(a.high_m - a.low_m, b.high_m - b.low_m);
  if (high_m - low_m <
      std::max(context.params.overlap_share * shorter_m, context.params.shortest_m)) {
    return std::nullopt;
  }
  SamePlacePair pair;
  std::vector<double> across_m;
  const int steps = std::max(1, static_cast<int>(std::ceil((high_m - low_m) / kSpacing_m)));
  for (int i = 0; i <= steps; ++i) {
    const double at_m = low_m + (high_m - low_m) * i / steps;
    const std::size_t first = nearest_pose(context.poses, earlier, a.along, at_m);
    const std::size_t second = nearest_pose(context.poses, later, a.along, at_m);
    across_m.push_back(
        (context.poses[second].translation() - context.poses[first].translation())[1 - a.along]);
    pair.beside.push_back({.earlier = first, .later = second, .across_m = across_m.back()});
  }
  std::ranges::sort(across_m);
  pair.across_m = quantile_of_sorted(across_m, 0.5);
  pair.probability = probability_of(pair.across_m, context.params);
  return pair;
}

NodeEnds ends_of(std::span<const Se2> poses, const TopologicalNode& node) {
  return {.from_in_manhattan = poses[node.first].translation(),
          .to_in_manhattan = poses[node.last].translation()};
}

/// Probabilities by the comparator instead.
void compare_by_network(std::vector<SamePlacePair>& pairs, std::span<const Se2> poses,
                        std::span<const TopologicalNode> nodes) {
  std::vector<NodeEndsPair> ends;
  for (const SamePlacePair& pair : pairs) {
    ends.push_back({ends_of(poses, nodes[pair.earlier]), ends_of(poses, nodes[pair.later])});
  }
  const std::vector<double> distances = PlaceComparator(shipped_place_comparator()).distances(ends);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].probability = std::clamp(1.0 - distances[i], 0.0, 1.0);
  }
}

}  // namespace

std::span<const std::pair<std::string_view, PlaceComparison>> names_of(PlaceComparison) {
  return kComparisons;
}

void validate(const SamePlaceParams& params) {
  require_above("shortest_m", params.shortest_m, 0.0);
  require_in_range("overlap_share", params.overlap_share, 0.01, 1.0);
  require_in_range("most_skew_deg", params.most_skew_deg, 1.0, 45.0);
  require_above("pass_sigma_m", params.pass_sigma_m, 0.0);
  require_above("aisle_spacing_m", params.aisle_spacing_m, 0.0);
  require_in_range("confident", params.confident, 0.0, 1.0);
  require_in_range("possible", params.possible, 0.0, 1.0);
}

PosesBeside typical(const SamePlacePair& pair) {
  check(!pair.beside.empty(), "a pair has poses side by side");
  std::vector<PosesBeside> beside = pair.beside;
  const auto median = beside.begin() + static_cast<std::ptrdiff_t>(beside.size() / 2);
  std::ranges::nth_element(beside, median, {}, &PosesBeside::across_m);
  return *median;
}

std::vector<SamePlacePair> same_places(std::span<const Se2> manhattan_from_robot,
                                       const Travel& travel, std::span<const TopologicalNode> nodes,
                                       const SamePlaceParams& params, double least_probability) {
  validate(params);
  check(manhattan_from_robot.size() == travel.way_m.size(), "the travel of these poses");
  std::vector<std::optional<AxisNode>> axes;
  axes.reserve(nodes.size());
  for (const TopologicalNode& node : nodes) {
    axes.push_back(axis_node(manhattan_from_robot, node, params));
  }
  const Compared context{.poses = manhattan_from_robot, .params = params};
  std::vector<SamePlacePair> pairs;
  for (std::size_t later = 0; later < nodes.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const bool comparable = axes[earlier] && axes[later] &&
                              axes[earlier]->along == axes[later]->along &&
                              nodes[earlier].label == nodes[later].label;
      if (!comparable) {
        continue;
      }
      auto pair = compared(context, nodes[earlier], *axes[earlier], nodes[later], *axes[later]);
      if (pair) {
        pair->earlier = earlier;
        pair->later = later;
        pairs.push_back(*std::move(pair));
      }
    }
  }
  if (params.comparison == PlaceComparison::Siamese) {
    compare_by_network(pairs, manhattan_from_robot, nodes);
  }
  std::erase_if(pairs,
                [&](const SamePlacePair& pair) { return pair.probability < least_probability; });
  return pairs;
}

}  // namespace sketchloc

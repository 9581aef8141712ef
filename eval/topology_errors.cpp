#include <algorithm>
#include <stdexcept>

#include "eval/topology_record.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

ErrorSummary aligned_errors(const MatchedPoses& poses, Alignment alignment) {
  return absolute_errors(align(poses, alignment).value()).translation_m.value();
}

/// The share of one node's poses that lie near the other node.
double share_near(std::span<const Se2> poses, const TopologicalNode& of,
                  const TopologicalNode& other, double near_m) {
  std::size_t near = 0;
  for (std::size_t i = of.first; i <= of.last; ++i) {
    for (std::size_t j = other.first; j <= other.last; ++j) {
      if ((poses[i].translation() - poses[j].translation()).squaredNorm() < near_m * near_m) {
        ++near;
        break;
      }
    }
  }
  return static_cast<double>(near) / static_cast<double>(of.last - of.first + 1);
}

}  // namespace

MetricErrors metric_errors(const MetricTrajectory& reference, const MetricTrajectory& estimate) {
  const MatchedPoses poses = match_poses(reference, estimate);
  if (poses.estimate_from_robot.empty()) {
    throw std::invalid_argument("no pose of the estimate has the time of one of the reference");
  }
  return {.unaligned = aligned_errors(poses, Alignment::None),
          .first_pose = aligned_errors(poses, Alignment::FirstPose),
          .se2 = aligned_errors(poses, Alignment::Se2)};
}

PairCounts count_pairs(const RecoveredRun& run, std::span<const Se2> world_from_robot,
                       double near_m) {
  check(run.manhattan_from_robot.size() == world_from_robot.size(), "one reference per pose");
  const std::vector<TopologicalNode>& nodes = run.nodes;
  const auto is_one_place = [&](std::size_t a, std::size_t b) {
    return nodes[a].label == nodes[b].label &&
           std::max(share_near(world_from_robot, nodes[a], nodes[b], near_m),
                    share_near(world_from_robot, nodes[b], nodes[a], near_m)) >= 0.5;
  };
  PairCounts counts{.used = run.pairs.size()};
  for (const SamePlacePair& pair : run.pairs) {
    counts.right += is_one_place(pair.earlier, pair.later) ? 1U : 0U;
  }
  for (std::size_t later = 0; later < nodes.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      counts.all += is_one_place(earlier, later) ? 1U : 0U;
    }
  }
  return counts;
}

}  // namespace sketchloc

#include "motion/graph/linear_start.hpp"

#include <algorithm>

#include "motion/graph/detail/linear_poses.hpp"

namespace sketchloc {

std::vector<GraphPose> linear_start(const PoseGraph& graph) {
  detail::LinearPoses linear(graph);
  const std::vector<double> weights(linear.edges().size(), 1.0);
  linear.turn(weights);
  linear.straighten(weights);
  linear.place(weights);
  return linear.poses();
}

std::vector<GraphPose> dead_reckoning(const PoseGraph& graph) {
  std::vector<GraphPose> poses;
  for (const GraphVertex& vertex : graph.vertices) {
    poses.push_back(vertex.frame_from_body);
  }
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> edge_to(poses.size(), kNone);  // from the vertex before
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    const std::size_t later = std::max(edge.first, edge.second);
    const bool is_step =
        edge.kind == EdgeKind::Between && edge.first + edge.second + 1 == 2 * later;
    if (is_step && edge_to[later] == kNone) {
      edge_to[later] = i;
    }
  }
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (edge_to[i] != kNone) {
      const GraphEdge& edge = graph.edges[edge_to[i]];
      const GraphPose step =
          edge.first < edge.second ? edge.measured : between(edge.measured, GraphPose{});
      poses[i] = compose(poses[i - 1], step);
    }
  }
  return poses;
}

}  // namespace sketchloc

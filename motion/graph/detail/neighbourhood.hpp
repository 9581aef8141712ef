#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/pose_graph.hpp"

namespace sketchloc::detail {

/// A graph with the edges of each of its vertices, for growing.
class LinkedGraph {
 public:
  std::size_t add(const GraphVertex& vertex);
  std::size_t add(const GraphEdge& edge);

  const PoseGraph& graph() const { return graph_; }
  void move(std::size_t vertex, const GraphPose& pose) {
    graph_.vertices[vertex].frame_from_body = pose;
  }
  void place(std::vector<GraphPose> poses);

  /// A part of the graph: the vertices nearest (in edges) to the seeds, as many as are wanted, and
  /// around them, fixed, those that share an edge with them; with all edges of the former.
  struct Part {
    PoseGraph graph;
    std::vector<std::size_t> vertices;  ///< which ones they are in the whole
    std::size_t moving = 0;             ///< the first ones; the rest is around them
  };
  Part around(std::span<const std::size_t> seeds, std::size_t count) const;

 private:
  std::vector<std::size_t> nearest(std::span<const std::size_t> seeds, std::size_t count) const;

  PoseGraph graph_;
  std::vector<std::vector<std::size_t>> edges_of_;
  mutable std::vector<std::size_t> places_;  ///< scratch: of the vertices in a part, else kNowhere
};

}  // namespace sketchloc::detail

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "motion/pose_graph.hpp"

namespace sketchloc::detail {

/// Poses by two linear systems over the Between edges of a graph, first headings, then positions;
/// each edge counts with a weight, and those of weight 0 cost nothing to solve. Held are the fixed
/// vertices and one of each connected part.
class LinearPoses {
 public:
  explicit LinearPoses(const PoseGraph& graph);
  ~LinearPoses();

  /// The edges that count, in their order in the graph.
  std::span<const GraphEdge> edges() const;
  const std::vector<GraphPose>& poses() const;

  /// Headings by the chordal relaxation: unit complex numbers without the constraint on their
  /// length [Carlone15].
  void turn(std::span<const double> weights);
  /// The headings nearest to those there are that agree best with the edges, in least squares.
  void straighten(std::span<const double> weights);
  /// Positions, once the headings are known.
  void place(std::span<const double> weights);

  /// Per edge, in standard deviations.
  std::vector<double> squared_heading_errors() const;
  std::vector<double> squared_position_errors() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sketchloc::detail

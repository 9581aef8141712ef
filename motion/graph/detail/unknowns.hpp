#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motion/graph/detail/cholesky.hpp"
#include "motion/pose_graph.hpp"

namespace sketchloc::detail {

/// What is known of some poses together: the cost e^T information e + 2 gradient^T e, where e is
/// what their numbers differ by from the reference (headings wrapped). Marginalization leaves it.
struct DensePrior {
  std::vector<std::size_t> vertices;
  std::vector<GraphPose> reference;
  Eigen::MatrixXd information;  ///< 3 or 4 rows per vertex, by its kind
  Eigen::VectorXd gradient;
};

/// Numbers of a vertex that are estimated.
inline int size_of(VertexKind kind) { return kind == VertexKind::Se2 ? 3 : 4; }

std::vector<int> block_sizes(const PoseGraph& graph);

/// Which vertices stay where they are: those that are fixed, and one of each connected part in
/// which nothing else says where it lies (a rigid one, where there is one). The first ones.
std::vector<bool> held_vertices(const PoseGraph& graph, const DensePrior* prior = nullptr);

/// Where the numbers of each vertex stand in the vector of unknowns, in the order of elimination,
/// and the pattern of the matrix of the normal equations.
class Unknowns {
 public:
  /// `sizes`: numbers per vertex, such as block_sizes(graph). `joins`: which edges share a block
  /// between their vertices; empty: all.
  Unknowns(const PoseGraph& graph, const std::vector<bool>& held, const DensePrior* prior,
           std::vector<int> sizes, const std::vector<bool>& joins = {});

  int size() const { return pattern_.size(); }
  const LowerPattern& pattern() const { return pattern_; }
  bool moves(std::size_t vertex) const { return offsets_[vertex] >= 0; }
  int offset(std::size_t vertex) const { return offsets_[vertex]; }  ///< -1: it stays
  int size_of(std::size_t vertex) const { return sizes_[vertex]; }   ///< 3 or 4
  std::size_t vertices() const { return sizes_.size(); }

  /// Where the entries of a block stand among the pattern's values: (row, column) at base + row +
  /// column (length - 1) - column (column - 1) / 2. Of the diagonal only row >= column.
  struct Slot {
    int base = -1;
    int length = 0;

    int at(int row, int column) const {
      return base + row + column * (length - 1) - column * (column - 1) / 2;
    }
  };
  /// The block of two moving vertices; its columns are those with the smaller offset. They must
  /// share an edge, the prior, or be the same.
  Slot slot(std::size_t first, std::size_t second) const;

 private:
  void lay_out(const std::vector<std::size_t>& moving, const LowerPattern& blocks);

  LowerPattern pattern_;
  std::vector<int> offsets_;
  std::vector<int> sizes_;
};

}  // namespace sketchloc::detail

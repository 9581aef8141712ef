#include "motion/graph/detail/marginal.hpp"

#include <Eigen/QR>

namespace sketchloc::detail {
namespace {

/// The whole of H, in the order of the unknowns.
Eigen::MatrixXd dense(const NormalEquations& equations) {
  const LowerPattern& pattern = equations.unknowns().pattern();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(pattern.size(), pattern.size());
  for (int column = 0; column < pattern.size(); ++column) {
    const int end = pattern.column_starts[static_cast<std::size_t>(column) + 1];
    for (int i = pattern.column_starts[static_cast<std::size_t>(column)]; i < end; ++i) {
      const int row = pattern.rows[static_cast<std::size_t>(i)];
      matrix(row, column) = matrix(column, row) = equations.values()[static_cast<std::size_t>(i)];
    }
  }
  return matrix;
}

/// The unknowns of the vertices that are wanted, one vertex after the other.
std::vector<int> indices_of(const Unknowns& unknowns, const std::vector<std::size_t>& vertices) {
  std::vector<int> indices;
  for (const std::size_t vertex : vertices) {
    for (int i = 0; i < unknowns.size_of(vertex); ++i) {
      indices.push_back(unknowns.offset(vertex) + i);
    }
  }
  return indices;
}

}  // namespace

DensePrior marginal(const PoseGraph& graph, const std::vector<bool>& gone,
                    const std::vector<bool>& held, const DensePrior* prior,
                    const RobustKernel& kernel) {
  NormalEquations equations(graph, held, prior);
  equations.linearise(poses_of(graph), {.kernel = kernel});
  DensePrior left;
  std::vector<std::size_t> leaving;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    if (!equations.unknowns().moves(i)) {
      continue;
    }
    if (gone[i]) {
      leaving.push_back(i);
    } else {
      left.vertices.push_back(i);
      left.reference.push_back(graph.vertices[i].frame_from_body);
    }
  }
  const std::vector<int> keep = indices_of(equations.unknowns(), left.vertices);
  const std::vector<int> drop = indices_of(equations.unknowns(), leaving);
  const Eigen::MatrixXd matrix = dense(equations);
  const Eigen::VectorXd& gradient = equations.gradient();
  left.information = matrix(keep, keep);
  left.gradient = gradient(keep);
  if (!drop.empty()) {
    const Eigen::MatrixXd across = matrix(keep, drop);
    const Eigen::MatrixXd inner = matrix(drop, drop);
    const Eigen::VectorXd inner_gradient = gradient(drop);
    // A pseudo-inverse: what nothing measured tells nothing.
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(inner);
    left.information -= across * solver.solve(across.transpose());
    left.gradient -= across * solver.solve(inner_gradient);
  }
  left.information = (0.5 * (left.information + left.information.transpose())).eval();
  return left;
}

}  // namespace sketchloc::detail

#include "motion/graph/covariance.hpp"

#include "motion/check.hpp"
#include "motion/graph/detail/normal_equations.hpp"

namespace sketchloc {

using detail::Cholesky;
using detail::NormalEquations;
using detail::Unknowns;

std::optional<std::vector<Eigen::MatrixXd>> covariances(const PoseGraph& graph,
                                                        std::span<const std::size_t> vertices,
                                                        std::span<const double> weights) {
  validate(graph);
  check(weights.empty() || weights.size() == graph.edges.size(), "one weight per edge");
  NormalEquations equations(graph, detail::held_vertices(graph));
  equations.linearise(detail::poses_of(graph), {.given = weights});
  const Unknowns& unknowns = equations.unknowns();
  Cholesky cholesky(unknowns.pattern());
  if (!cholesky.factorise(equations.values())) {
    return std::nullopt;
  }
  std::vector<Eigen::MatrixXd> result;
  for (const std::size_t vertex : vertices) {
    check(vertex < graph.vertices.size(), "a vertex of the graph");
    const int size = unknowns.size_of(vertex);
    Eigen::MatrixXd& covariance = result.emplace_back(Eigen::MatrixXd::Zero(size, size));
    if (unknowns.moves(vertex)) {
      Eigen::MatrixXd units = Eigen::MatrixXd::Zero(unknowns.size(), size);
      units.middleRows(unknowns.offset(vertex), size).setIdentity();
      covariance = cholesky.solve_columns(units).middleRows(unknowns.offset(vertex), size);
    }
  }
  return result;
}

}  // namespace sketchloc

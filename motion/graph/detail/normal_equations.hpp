#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "motion/graph/detail/edge_error.hpp"
#include "motion/graph/detail/unknowns.hpp"
#include "motion/graph/kernel.hpp"

namespace sketchloc::detail {

/// How much each edge counts.
struct EdgeWeighting {
  RobustKernel kernel = {};            ///< of the edges that may be wrong
  std::span<const double> given = {};  ///< one more factor per edge; empty: 1
};

/// The cost of a graph, sum of r^T information r (no factor 1/2) behind its kernels, and its
/// second-order model in the vector of unknowns: cost + 2 gradient^T step + step^T H step.
class NormalEquations {
 public:
  /// The graph and the prior must outlive it. `joins`: edges whose vertices share a block of H, the
  /// others count in the gradient and on the diagonal; empty: all.
  NormalEquations(const PoseGraph& graph, const std::vector<bool>& held,
                  const DensePrior* prior = nullptr, const std::vector<bool>& joins = {});

  const Unknowns& unknowns() const { return unknowns_; }

  double cost(std::span<const GraphPose> poses, const EdgeWeighting& weighting) const;
  /// Without kernels, per edge.
  std::vector<double> chi2_of_edges(std::span<const GraphPose> poses) const;
  /// What each edge counts.
  std::vector<double> weights(std::span<const GraphPose> poses,
                              const EdgeWeighting& weighting) const;

  /// Fills H and the gradient. Edges that are doubted count with the kernel's slope.
  void linearise(std::span<const GraphPose> poses, const EdgeWeighting& weighting);
  const Eigen::VectorXd& gradient() const { return gradient_; }
  std::span<const double> values() const { return values_; }  ///< of H, in the unknowns' pattern
  Eigen::VectorXd diagonal() const;
  void add_to_diagonal(const Eigen::VectorXd& damping);
  double curvature(const Eigen::VectorXd& step) const;  ///< step^T H step

  /// The poses after a step.
  std::vector<GraphPose> moved(std::span<const GraphPose> poses, const Eigen::VectorXd& step) const;

 private:
  struct EdgeSlots {
    Unknowns::Slot first;
    Unknowns::Slot second;
    Unknowns::Slot both;
    bool first_is_column = false;
  };
  double weight(std::size_t edge, double chi2, const EdgeWeighting& weighting) const;
  template <int kSize>
  void add_edge(std::size_t index, const EdgeWeighting& weighting);
  void add_prior(std::span<const GraphPose> poses);
  Eigen::VectorXd prior_difference(std::span<const GraphPose> poses) const;
  void turn(std::span<const GraphPose> poses) const;

  const PoseGraph* graph_;
  const DensePrior* prior_;
  Unknowns unknowns_;
  bool is_rigid_ = true;  ///< no vertex has a scale
  std::vector<Eigen::Matrix4d> information_;
  std::vector<EdgeSlots> slots_;
  mutable std::vector<TurnedPose> turned_;  ///< scratch
  std::vector<double> values_;
  Eigen::VectorXd gradient_;
};

/// One pose per vertex.
std::vector<GraphPose> poses_of(const PoseGraph& graph);

}  // namespace sketchloc::detail

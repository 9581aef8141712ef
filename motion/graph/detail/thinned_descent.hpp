#pragma once

#include <optional>
#include <vector>

#include "motion/graph/detail/descent.hpp"

namespace sketchloc::detail {

/// A minimization where most edges that may be wrong can weigh next to nothing. Those join no
/// vertices in the matrix, where wrong ones would fill it with numbers: they count in the gradient
/// and on the diagonal. Which ones they are is found out anew as the poses move.
class ThinnedDescent {
 public:
  /// The graph must outlive it.
  ThinnedDescent(const PoseGraph& graph, std::vector<GraphPose> poses,
                 const OptimiseParams& params);

  /// As Descent::run().
  OptimiseResult::Status run(const EdgeWeighting& weighting, int most_iterations);

  const std::vector<GraphPose>& poses() const { return poses_; }
  int iterations() const { return iterations_; }
  // Where the poses are:
  std::vector<double> chi2_of_edges() const { return costs_.chi2_of_edges(poses_); }
  std::vector<double> weights(const EdgeWeighting& weighting) const {
    return costs_.weights(poses_, weighting);
  }
  double cost(const EdgeWeighting& weighting) const { return costs_.cost(poses_, weighting); }

 private:
  /// Whether the matrix has the edges it should have now.
  bool fits(const std::vector<double>& weights) const;
  void thin(const std::vector<double>& weights);

  const PoseGraph* graph_;
  OptimiseParams params_;
  std::vector<bool> held_;
  NormalEquations costs_;    ///< of no unknowns
  std::vector<bool> joins_;  ///< edges that the matrix has
  std::optional<NormalEquations> equations_;
  std::optional<Descent> descent_;
  std::vector<GraphPose> poses_;
  int iterations_ = 0;
};

}  // namespace sketchloc::detail

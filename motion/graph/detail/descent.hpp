#pragma once

#include <vector>

#include "motion/graph/detail/normal_equations.hpp"
#include "motion/graph/optimise.hpp"

namespace sketchloc::detail {

/// A minimization under way, from poses towards a minimum of the cost under a weighting that may
/// change between calls.
class Descent {
 public:
  /// The equations must outlive it.
  Descent(NormalEquations& equations, std::vector<GraphPose> poses, const OptimiseParams& params);

  /// Steps until the cost stands still, at most `most_iterations` more. The status is of this call.
  OptimiseResult::Status run(const EdgeWeighting& weighting, int most_iterations);

  const std::vector<GraphPose>& poses() const { return poses_; }
  double cost() const { return cost_; }
  double radius() const { return radius_; }  ///< of the trust region
  int iterations() const { return iterations_; }

 private:
  bool factorise();
  /// One accepted step, or none within reach.
  bool step(const EdgeWeighting& weighting);
  Eigen::VectorXd dogleg(const Eigen::VectorXd& newton, const Eigen::VectorXd& scale) const;

  NormalEquations* equations_;
  Cholesky cholesky_;
  std::vector<GraphPose> poses_;
  double tolerance_;
  double radius_;
  double cost_ = 0.0;
  double decrease_ = 0.0;  ///< of the last step
  int iterations_ = 0;
};

}  // namespace sketchloc::detail

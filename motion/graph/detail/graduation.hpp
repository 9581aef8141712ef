#pragma once

#include <span>
#include <vector>

#include "motion/graph/optimise.hpp"

namespace sketchloc::detail {

// Truncated least squares is reached over problems that a number mu tells apart, from 0 (convex) to
// infinity (truncated) [Yang20]. Errors are squared, in standard deviations; `bound` is where they
// are truncated.

/// The mu at which the worst error still counts in full; 0 where none is cut off.
double convex_mu(std::span<const double> chi2s, double bound);
/// The weight of an error in the problem of mu [Yang20 eq. 14].
double graduated_weight(double chi2, double bound, double mu);
/// Whether each weight is 0 or 1, but for a thousandth.
bool are_decided(std::span<const double> weights);

struct TruncatedOptimum {
  OptimiseResult::Status status = OptimiseResult::Status::Singular;
  std::vector<GraphPose> poses = {};
  double cost = 0.0;     ///< truncated
  bool rejects = false;  ///< some edge is farther off than the width
  int iterations = 0;
};
/// Truncated least squares at the width of the kernel, from poses that may be some of these widths
/// off: with fewer and fewer of the edges that may be wrong and disagree, until none of them
/// changes sides any more.
TruncatedOptimum truncated_optimum(const PoseGraph& graph, std::vector<GraphPose> poses,
                                   const OptimiseParams& params);

}  // namespace sketchloc::detail

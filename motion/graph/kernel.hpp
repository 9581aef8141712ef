#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace sketchloc {

/// How much an edge that may be wrong can cost.
enum class KernelShape {
  None,       ///< chi2
  Huber,      ///< grows linearly in the error from the width on
  Cauchy,     ///< grows logarithmically
  Dcs,        ///< dynamic covariance scaling [Agarwal13]: bounded
  Graduated,  ///< truncated at the width, reached over smoother problems [Yang20]
};
std::span<const std::pair<std::string_view, KernelShape>> names_of(KernelShape);

struct RobustKernel {
  KernelShape shape = KernelShape::None;
  /// Error in standard deviations from which an edge is doubted, > 0. 3.37 is the 99 % quantile of
  /// chi with 3 degrees of freedom.
  double width = 3.37;
};
void validate(const RobustKernel& kernel);
/// Throws std::invalid_argument for the graduated one, which needs the whole graph: graphs that
/// grow have none.
void require_no_graduation(const RobustKernel& kernel);

template <typename Visitor>
void visit_fields(RobustKernel& kernel, Visitor&& visit) {
  visit("shape", kernel.shape);
  visit("width", kernel.width);
}

/// What an edge costs whose squared error in standard deviations is chi2; at most chi2.
double robust_cost(const RobustKernel& kernel, double chi2);
/// Its derivative by chi2, the weight of the edge in least squares, in [0, 1].
double robust_weight(const RobustKernel& kernel, double chi2);

}  // namespace sketchloc

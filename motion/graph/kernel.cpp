#include "motion/graph/kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "motion/validate.hpp"

namespace sketchloc {

std::span<const std::pair<std::string_view, KernelShape>> names_of(KernelShape /*shape*/) {
  static constexpr auto kNames = std::to_array<std::pair<std::string_view, KernelShape>>(
      {{"none", KernelShape::None},
       {"huber", KernelShape::Huber},
       {"cauchy", KernelShape::Cauchy},
       {"dcs", KernelShape::Dcs},
       {"graduated", KernelShape::Graduated}});
  return kNames;
}

void validate(const RobustKernel& kernel) { require_above("width", kernel.width, 0.0); }

void require_no_graduation(const RobustKernel& kernel) {
  if (kernel.shape == KernelShape::Graduated) {
    throw std::invalid_argument(
        "kernel.shape: must be none, huber, cauchy or dcs for a graph that grows, is graduated");
  }
}

double robust_cost(const RobustKernel& kernel, double chi2) {
  const double bound = kernel.width * kernel.width;
  switch (kernel.shape) {
    case KernelShape::None:
      return chi2;
    case KernelShape::Huber:
      return chi2 <= bound ? chi2 : 2.0 * kernel.width * std::sqrt(chi2) - bound;
    case KernelShape::Cauchy:
      return bound * std::log1p(chi2 / bound);
    case KernelShape::Dcs:  // the integral of its weight
      return chi2 <= bound ? chi2 : bound * (3.0 * chi2 - bound) / (chi2 + bound);
    case KernelShape::Graduated:
      return std::min(chi2, bound);
  }
  return chi2;
}

double robust_weight(const RobustKernel& kernel, double chi2) {
  const double bound = kernel.width * kernel.width;
  switch (kernel.shape) {
    case KernelShape::None:
      return 1.0;
    case KernelShape::Huber:
      return chi2 <= bound ? 1.0 : kernel.width / std::sqrt(chi2);
    case KernelShape::Cauchy:
      return bound / (bound + chi2);
    case KernelShape::Dcs: {
      const double s = std::min(1.0, 2.0 * bound / (bound + chi2));
      return s * s;
    }
    case KernelShape::Graduated:
      return chi2 <= bound ? 1.0 : 0.0;
  }
  return 1.0;
}

}  // namespace sketchloc

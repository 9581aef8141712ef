#include "motion/quantile.hpp"

#include <algorithm>
#include <cmath>

#include "motion/check.hpp"

namespace sketchloc {

double quantile_of_sorted(std::span<const double> sorted, double share) {
  check(!sorted.empty(), "a quantile needs a value");
  check(share >= 0.0 && share <= 1.0, "the share of a quantile lies in [0, 1]");
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

}  // namespace sketchloc

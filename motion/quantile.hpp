#pragma once

#include <span>

namespace sketchloc {

/// The value below which a share (0..1) of sorted values lies, linear between order statistics
/// (position share * (n - 1)). Needs at least one value.
double quantile_of_sorted(std::span<const double> sorted, double share);

}  // namespace sketchloc

#pragma once

#include <cstdint>
#include <vector>

#include "eval/filter_suite.hpp"
#include "eval/filter_trials.hpp"

namespace sketchloc {

/// Drives in which the robot is lost, a kind each, in buildings drawn as people draw: `global
/// start` (nothing is known), `kidnapped` (half way, it is carried at least 5 m away to where
/// another drive starts, and nobody tells it) and `wrong drawing` (the drawing is of another
/// building).
std::vector<FilterTask> lost_drives(const FilterSuiteParams& params, std::uint64_t seed);

/// A drive and one that follows it after somebody carried the robot: the odometry does not notice.
FilterData carried(FilterData first, const FilterData& second);

}  // namespace sketchloc

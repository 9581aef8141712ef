#pragma once

#include <cstdint>
#include <vector>

#include "eval/filter_trials.hpp"

namespace sketchloc {

/// What the simulated filter suites run.
struct FilterSuiteParams {
  int plans = 6;          ///< buildings, >= 0
  int drawings = 2;       ///< of each, one drive in each, >= 1
  double drive_m = 60.0;  ///< way of a drive, > 0
};

template <typename Visitor>
void visit_fields(FilterSuiteParams& params, Visitor&& visit) {
  visit("plans", params.plans);
  visit("drawings", params.drawings);
  visit("drive_m", params.drive_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const FilterSuiteParams& params);

/// Drives in simulated buildings: kinds `tps` and `human`, by who drew.
std::vector<FilterTask> simulated_drives(const FilterSuiteParams& params, std::uint64_t seed);

/// What may go wrong, a kind each, in the buildings of simulated_drives, drawn as people draw:
/// `plain` (nothing), `odometry 20 %` and `odometry 40 %` (noise as a share of the way and of the
/// turn), `walls missing` (a fifth of the inner walls is not drawn) and `dropouts` (a third of the
/// scans see nothing).
std::vector<FilterTask> robust_drives(const FilterSuiteParams& params, std::uint64_t seed);

}  // namespace sketchloc

#pragma once

#include "datasets/scan.hpp"
#include "motion/se2.hpp"

namespace sketchloc {

/// Where one scan ends a beam at least this far in front of what another one saw behind it, one of
/// them is elsewhere than the odometry says, or something moved.
struct ContradictionParams {
  double tolerance_m = 0.5;      ///< >= 0
  double tolerance_per_m = 0.1;  ///< more of it farther away, >= 0
  int neighbours = 2;            ///< beams to either side that may excuse it, >= 0
};

template <typename Visitor>
void visit_fields(ContradictionParams& params, Visitor&& visit) {
  visit("tolerance_m", params.tolerance_m);
  visit("tolerance_per_m", params.tolerance_per_m);
  visit("neighbours", params.neighbours);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const ContradictionParams& params);

/// The share of two scans' end points that lie where the other scan saw free space, of those in
/// directions that it saw, in [0, 1]; 0 where none do. It needs no map: a robot that was carried
/// away contradicts what it saw before.
double contradiction(const Scan& now, const Scan& before, const Se2& before_from_now,
                     const ContradictionParams& params = {});

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "datasets/scan.hpp"

namespace sketchloc {

/// Which beams of a scan are scored.
struct BeamSelection {
  int beams = 60;             ///< spread evenly over the field of view, in [1, 4096]
  double max_range_m = 20.0;  ///< farther returns only say that it is at least this far, > 0
};

template <typename Visitor>
void visit_fields(BeamSelection& selection, Visitor&& visit) {
  visit("beams", selection.beams);
  visit("max_range_m", selection.max_range_m);
}

void validate(const BeamSelection& selection);

/// One of them.
struct SelectedBeam {
  Eigen::Vector2d end_in_robot;  ///< m; without a return where the beam was lost from sight
  bool returned = true;          ///< false: nothing as near as the end
};

/// Refills `selected`; keeps its memory. Each beam stands for an equal sector of the field of view
/// and is its middle reading. Readings that are no range at all (NaN, below the least) are left
/// out.
void select_beams(std::vector<SelectedBeam>& selected, const Scan& scan,
                  const BeamSelection& selection);

}  // namespace sketchloc

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
  double max_range_m = 20.0;  ///< farther returns are left out, > 0
};

template <typename Visitor>
void visit_fields(BeamSelection& selection, Visitor&& visit) {
  visit("beams", selection.beams);
  visit("max_range_m", selection.max_range_m);
}

void validate(const BeamSelection& selection);

/// Refills `ends_in_robot` with the ends of the selected beams; keeps its memory. Each stands for
/// an equal sector of the field of view and is its middle reading; sectors whose middle did not
/// return, or from too far, are left out.
void select_end_points(std::vector<Eigen::Vector2d>& ends_in_robot, const Scan& scan,
                       const BeamSelection& selection);

}  // namespace sketchloc

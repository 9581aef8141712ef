#pragma once

#include <cstddef>
#include <vector>

#include "datasets/scan.hpp"
#include "filter/beam_kernel.hpp"

namespace sketchloc {

/// Which beams of a scan are scored.
struct BeamSelection {
  int beams = 60;  ///< spread evenly over the field of view, in [1, 1024]
  double max_range_m =
      20.0;  ///< farther returns are left out: people do not draw that exactly, > 0
};
void validate(const BeamSelection& selection);

/// Refills `beams` with the selected returns of a scan; keeps its memory. Each stands for an equal
/// sector of the field of view and is its middle return; sectors without one are left out.
void select_beams(std::vector<Beam>& beams, const Scan& scan, const BeamSelection& selection);

}  // namespace sketchloc

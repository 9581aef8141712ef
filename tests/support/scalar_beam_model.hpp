#pragma once

#include <span>
#include <vector>

#include "datasets/grid.hpp"
#include "filter/beam_kernel.hpp"

namespace sketchloc::testing {

/// Oracle and baseline of the beam kernel: every beam walks cell by cell from where the particle
/// really is, in its real direction, in double.
std::vector<double> score_by_traversal(const Grid<std::uint8_t>& occupied,
                                       const BeamKernelParams& params,
                                       const ParticleSpans& particles, std::span<const Beam> beams,
                                       double max_range_px);

}  // namespace sketchloc::testing

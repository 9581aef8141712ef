#pragma once

#include <vector>

#include "datasets/sim/axis_stretch.hpp"

namespace sketchloc::detail {

/// What is wanted of a stretch at each node of its lattice.
struct StretchWishes {
  Grid<double> rate;          ///< wanted du'/du, > 0
  Grid<double> rate_weight;   ///< how much it matters, > 0
  Grid<double> shear;         ///< wanted du'/dv towards the next row
  Grid<double> shear_weight;  ///< how much it matters, > 0
};

/// The stretch that meets the wishes best (least squares over all nodes), with no rate below
/// min_rate. Rows far apart agree where shear weights are high: along straight walls.
AxisStretch relax_rows(const AxisStretch::Lattice& lattice, const StretchWishes& wishes,
                       double min_rate);

}  // namespace sketchloc::detail

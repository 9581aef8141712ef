#pragma once

#include <vector>

#include "motion/graph/detail/normal_equations.hpp"

namespace sketchloc::detail {

/// What the edges of a graph and a prior say about its vertices but `gone`, linear at the vertices'
/// poses: the Schur complement of the normal equations. Held vertices count as known.
DensePrior marginal(const PoseGraph& graph, const std::vector<bool>& gone,
                    const std::vector<bool>& held, const DensePrior* prior,
                    const RobustKernel& kernel);

}  // namespace sketchloc::detail

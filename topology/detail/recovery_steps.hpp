#pragma once

#include <vector>

#include "topology/recovered_run.hpp"

namespace sketchloc::detail {

/// Fills in headings and drift from a tracker that has seen the evidence's pieces.
void decide_headings(HeadingEvidence& evidence, const DriftTracker& tracker);

/// Optimizes `bare`, the run's odometry, and these pairs. The first poses start where the run's
/// last optimum had them, later ones behind them.
void optimise_with(RecoveredRun& run, const PoseGraph& bare, std::vector<SamePlacePair> pairs,
                   const TopologyParams& params);

}  // namespace sketchloc::detail

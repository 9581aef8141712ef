#pragma once

#include <span>
#include <vector>

#include "topology/recovered_run.hpp"

namespace sketchloc::detail {

/// Fills in headings and drift from a tracker that has seen the evidence's pieces.
void decide_headings(HeadingEvidence& evidence, const DriftTracker& tracker);

/// A run as its odometry and headings have it.
struct BareRun {
  PoseGraph graph = {};              ///< steps and axes
  std::span<const Scan> scans = {};  ///< one for each pose, or none
};

/// Optimizes a bare run and these pairs. The first poses start where the run's last optimum had
/// them, later ones behind them.
void optimise_with(RecoveredRun& run, const BareRun& bare, std::vector<SamePlacePair> pairs,
                   const TopologyParams& params);

}  // namespace sketchloc::detail

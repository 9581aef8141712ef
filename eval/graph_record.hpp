#pragma once

#include <optional>
#include <string>

#include "motion/graph/optimise.hpp"

namespace sketchloc {

/// How a graph was smoothed while it grew.
struct GrowingRecord {
  std::size_t updates = 0;
  std::size_t batches = 0;          ///< of them moved the whole graph
  double mean_update_s = 0.0;       ///< wall clock
  double worst_update_s = 0.0;      ///< wall clock
  double chi2_before_finish = 0.0;  ///< after the last update
};

/// A pose graph that was smoothed.
struct GraphRecord {
  PoseGraph before = {};
  PoseGraph after = {};
  OptimiseResult result = {};
  OptimiseParams params = {};
  double start_chi2 = 0.0;                    ///< of `before`
  double seconds = 0.0;                       ///< wall clock, without reading and writing
  std::optional<GrowingRecord> growing = {};  ///< none: it was smoothed at once
  std::optional<double> rmse_m = {};          ///< of the positions, see position_rmse_m()
};

/// "converged" and the like.
std::string name_of(OptimiseResult::Status status);
/// Edges that may be wrong, and those of them that were taken for it (weight under 1/2).
std::size_t doubted_edges(const GraphRecord& record);
std::size_t rejected_edges(const GraphRecord& record);

/// Root mean square distance between the positions of vertices of one id, after the rigid motion
/// that makes it least. None where fewer than two have a partner.
std::optional<double> position_rmse_m(const PoseGraph& estimate, const PoseGraph& reference);

/// `metrics.json`, see docs/formats.md.
std::string to_json(const GraphRecord& record);

/// `picture.png`: the poses and loop closures before and after, as the bytes of a PNG file.
std::string picture_png(const GraphRecord& record);

}  // namespace sketchloc

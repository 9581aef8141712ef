#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/run_record.hpp"

namespace sketchloc::detail {

/// A step that the report shows in detail.
struct Moment {
  std::string letter;     ///< "A", "B", ... in the order of time
  std::size_t index = 0;  ///< into RunRecord::steps
  std::string reason;     ///< why it is shown, e.g. "largest error"; empty: one of evenly spread
  std::optional<StepError> error;
};

/// The largest error and the first loss (or, without a reference, the least certain step), and up
/// to `others` more, spread evenly over the run.
std::vector<Moment> choose_moments(const RunRecord& record, std::span<const StepError> errors,
                                   std::size_t others);

/// The snapshot taken nearest to a step; nullptr where there are none.
const ParticleSnapshot* nearest_snapshot(const RunRecord& record, std::size_t step);

}  // namespace sketchloc::detail

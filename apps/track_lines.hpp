#pragma once

#include <cstdint>
#include <string>

#include "apps/track_tally.hpp"
#include "filter/online/tracker.hpp"
#include "smoothing/lag_smoother.hpp"

namespace sketchloc {

// The lines that `sketchloc track` writes, as JSON without the end of line: docs/formats.md.

/// What became of one scan.
std::string scan_line(const TrackedScan& scan);

/// One line of JSON about a pose that was smoothed with a lag.
std::string lagged_line(const LaggedPose& lagged);

/// What came of the whole: the last line.
struct TrackEnd {
  const TrackTally& tally;
  const IntakeCounts& intake;
  std::uint64_t states_written = 0;
  std::string end;  ///< why it ended
  double seconds = 0.0;
};
std::string summary_line(const TrackEnd& end);

}  // namespace sketchloc

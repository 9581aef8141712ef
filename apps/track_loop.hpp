#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "apps/complaints.hpp"
#include "apps/lagged_track.hpp"
#include "apps/message_source.hpp"
#include "apps/state_file.hpp"
#include "apps/track_tally.hpp"
#include "filter/online/tracker.hpp"

namespace sketchloc {

/// Where lines go; false: nobody reads them any more.
using WriteLine = std::function<bool(std::string_view line)>;

/// What the loop is made of. All must outlive it.
struct TrackLoopParts {
  Tracker& tracker;
  MessageSource& source;
  WriteLine write;
  LaggedTrack* lagged = nullptr;          ///< null: nothing is smoothed
  StateKeeper* keeper = nullptr;          ///< null: no states are kept
  double state_every_s = 1.0;             ///< by the clock of arrivals
  std::optional<double> deadline_s = {};  ///< none: messages wait where they come from
};

/// Moves messages from a source through a tracker to where the results go, until the source ends,
/// nobody reads the results, or the program is asked to end. Says on stderr what is odd, each kind
/// at most once in a while.
class TrackLoop {
 public:
  explicit TrackLoop(TrackLoopParts parts);

  /// Gives the last line.
  std::string run();

  const TrackTally& tally() const { return tally_; }

 private:
  void take_what_came();
  void take(Arrival arrival);
  bool work();
  void work_all();
  void give_out(const TrackedScan& scan);
  void write(const std::string& line);
  bool smooth();
  void write_smoothed();
  void keep_state(bool at_once);
  void speak_of_intake();
  void speak_of(const TrackedScan& scan);
  void say(const std::string& kind, const std::string& what);
  std::string end_line(double begin_s) const;

  TrackLoopParts parts_;
  TrackTally tally_;
  Complaints complaints_;
  IntakeCounts spoken_of_;
  bool was_degraded_ = false;
  double kept_s_;
  std::string end_;  ///< why it ended; empty: it goes on
};

}  // namespace sketchloc

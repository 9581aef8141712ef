#pragma once

#include <cstdint>
#include <vector>

#include "filter/online/tracker.hpp"

namespace sketchloc {

/// How long something took, many times over, in bounded memory: to 0.05 ms, up to 10 s.
class Durations {
 public:
  void add(double seconds);
  std::uint64_t count() const { return count_; }
  double mean_s() const;
  double max_s() const { return max_s_; }
  /// The least duration that this share is not above; 0 where there are none.
  double quantile_s(double share) const;

 private:
  std::vector<std::uint32_t> bins_;
  std::uint64_t count_ = 0;
  double sum_s_ = 0.0;
  double max_s_ = 0.0;
};

/// What the online loop did, counted.
struct TrackTally {
  std::uint64_t malformed = 0;
  std::uint64_t with_nan = 0;  ///< messages
  std::uint64_t tracked = 0;
  std::uint64_t not_started = 0;
  std::uint64_t late = 0;  ///< scans refused, since newer ones waited
  std::uint64_t missed_deadlines = 0;
  std::uint64_t fewer_particles = 0;  ///< scans with a limit on them
  std::uint64_t registrations = 0;    ///< tried
  std::uint64_t held_back = 0;        ///< registrations that were due
  Durations latency;                  ///< of scans that were tracked
  Durations odometry;
  Durations localizer_without_registration;
  Durations localizer_with_registration;

  void add(const TrackedScan& scan);
};

}  // namespace sketchloc

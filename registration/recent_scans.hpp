#pragma once

#include <deque>
#include <vector>

#include "datasets/scan.hpp"
#include "motion/se2.hpp"
#include "motion/state_bytes.hpp"
#include "registration/scan_raster.hpp"

namespace sketchloc {

struct RecentScansParams {
  int max_scans = 6;          ///< the present one included, >= 1
  double spacing_m = 0.7;     ///< way between remembered scans, >= 0
  double max_turn_rad = 1.0;  ///< a scan that is turned by more is remembered too, > 0
};

template <typename Visitor>
void visit_fields(RecentScansParams& params, Visitor&& visit) {
  visit("max_scans", params.max_scans);
  visit("spacing_m", params.spacing_m);
  visit("max_turn_rad", params.max_turn_rad);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const RecentScansParams& params);

/// The scans of the last metres, placed by odometry: the local submap that registration looks at.
class RecentScans {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  explicit RecentScans(const RecentScansParams& params = {});

  /// Takes the present scan; odometry as good as matched_odometry's is needed.
  void add(const Scan& scan, const Se2& odom_from_robot);

  /// The present scan first, then back in time. Empty before the first scan; valid until the next
  /// one.
  std::vector<PlacedScan> placed() const;

  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  struct Entry {
    Scan scan;
    Se2 odom_from_robot;
  };

  RecentScansParams params_;
  std::deque<Entry> remembered_;  ///< newest first; the first one is the present scan
};

}  // namespace sketchloc

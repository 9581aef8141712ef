#include "registration/recent_scans.hpp"

#include <cmath>
#include <utility>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const RecentScansParams& params) {
  require_at_least("max_scans", params.max_scans, 1.0);
  require_at_least("spacing_m", params.spacing_m, 0.0);
  require_above("max_turn_rad", params.max_turn_rad, 0.0);
}

RecentScans::RecentScans(const RecentScansParams& params) : params_(params) { validate(params); }

void RecentScans::add(const Scan& scan, const Se2& odom_from_robot) {
  // The last scan stays only if it stands far enough from the one before it.
  if (remembered_.size() >= 2) {
    const Se2 older_from_last =
        remembered_[1].odom_from_robot.inverse() * remembered_[0].odom_from_robot;
    if (older_from_last.translation().norm() < params_.spacing_m &&
        std::abs(older_from_last.yaw_rad()) < params_.max_turn_rad) {
      remembered_.pop_front();
    }
  }
  remembered_.push_front({.scan = scan, .odom_from_robot = odom_from_robot});
  if (remembered_.size() > static_cast<std::size_t>(params_.max_scans)) {
    remembered_.pop_back();
  }
}

std::vector<PlacedScan> RecentScans::placed() const {
  std::vector<PlacedScan> scans;
  for (const Entry& entry : remembered_) {
    scans.push_back(
        {.scan = &entry.scan,
         .robot_from_then = remembered_.front().odom_from_robot.inverse() * entry.odom_from_robot});
  }
  return scans;
}

void RecentScans::save(StateWriter& state) const {
  state.put<std::uint64_t>(remembered_.size());
  for (const Entry& entry : remembered_) {
    sketchloc::save(entry.scan, state);
    state.put(entry.odom_from_robot);
  }
}

void RecentScans::load(StateReader& state) {
  std::deque<Entry> remembered(state.get_count(static_cast<std::size_t>(params_.max_scans)));
  for (Entry& entry : remembered) {
    entry.scan = load_scan(state);
    entry.odom_from_robot = state.get_se2();
  }
  remembered_ = std::move(remembered);
}

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "datasets/message.hpp"
#include "datasets/run.hpp"
#include "filter/online/stamps.hpp"
#include "motion/state_bytes.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// How messages become scans with odometry.
struct IntakeParams {
  StampParams stamps;
  double wait_s = 0.02;             ///< for the odometry after a scan that came without any, >= 0
  double hold_s = 1.0;              ///< odometry this far from a scan still stands for it, > 0
  double most_speed_mps = 3.0;      ///< odometry that moves faster has jumped, > 0
  double most_turn_radps = 6.0;     ///< or turns faster, > 0
  double jump_slack_m = 0.5;        ///< what it may move whatever the time, > 0
  double jump_slack_rad = 1.0;      ///< or turn, > 0
  std::size_t most_waiting = 1000;  ///< scans that wait for odometry; more are refused, >= 1
};

template <typename Visitor>
void visit_fields(IntakeParams& params, Visitor&& visit) {
  visit("stamps", params.stamps);
  visit("wait_s", params.wait_s);
  visit("hold_s", params.hold_s);
  visit("most_speed_mps", params.most_speed_mps);
  visit("most_turn_radps", params.most_turn_radps);
  visit("jump_slack_m", params.jump_slack_m);
  visit("jump_slack_rad", params.jump_slack_rad);
  visit("most_waiting", params.most_waiting);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const IntakeParams& params);

/// Why a scan was not used.
enum class Refusal { Duplicate, OutOfOrder, NoOdometry, Late };

/// A scan that was not used.
struct RefusedScan {
  double time_s = 0.0;
  double arrived_s = 0.0;
  Refusal why = Refusal::Duplicate;
};

/// A scan that can be used.
struct ReadyScan {
  RunStep step;            ///< its odometry goes on smoothly where the robot's own jumped
  double arrived_s = 0.0;  ///< by the clock of the loop
  std::optional<double> unmeasured_s =
      std::nullopt;  ///< the odometry jumped: nobody knows how the robot moved for so long
};

/// What came in, counted.
struct IntakeCounts {
  std::uint64_t messages = 0;
  std::uint64_t scans = 0;
  std::uint64_t duplicate_scans = 0;
  std::uint64_t out_of_order_scans = 0;
  std::uint64_t scans_without_odometry = 0;
  std::uint64_t odometry_out_of_order = 0;  ///< or duplicate
  std::uint64_t odometry_jumps = 0;
  std::uint64_t odometry_held = 0;  ///< scans that took older odometry, since newer did not come
  std::uint64_t gaps = 0;           ///< stamps of scans went ahead by more than longest_gap_s
  std::uint64_t clock_set_back = 0;
  std::uint64_t beam_count_changes = 0;
  std::uint64_t blind_scans = 0;  ///< without any return

  friend bool operator==(const IntakeCounts&, const IntakeCounts&) = default;
};

/// Puts what comes in into order: gives every scan its odometry, takes jumps out of the odometry
/// and refuses what cannot be used. Reads no clock: whoever calls says when messages arrived.
class Intake {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  explicit Intake(const IntakeParams& params);

  /// Arrival times must not decrease.
  void take(Message message, double arrived_s);

  /// Scans that have waited for odometry long enough take what there is, or are refused.
  void wait_until(double now_s);
  /// No more messages will come: nothing waits any longer.
  void end();

  std::optional<ReadyScan> next_ready();
  std::optional<RefusedScan> next_refused();
  bool waits() const { return !waiting_.empty(); }

  const IntakeCounts& counts() const { return counts_; }

  /// Stamps and odometry of the last scan. What waits is not kept.
  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  struct Waiting {
    Scan scan;
    double arrived_s = 0.0;
  };

  bool accepts_scan(const Scan& scan, double arrived_s);
  void count_oddities(const Scan& scan);
  Se2 continued(double time_s, const Se2& raw_odom_from_robot, double arrived_s);
  void remember_odometry(double time_s, const Se2& raw_odom_from_robot, double arrived_s);
  void resolve(double now_s, bool nothing_more);
  std::optional<Se2> odometry_at(double time_s) const;
  std::optional<Se2> odometry_held_for(double time_s) const;
  void make_ready(Scan scan, const Se2& odom_from_robot, double arrived_s);
  void refuse(double time_s, double arrived_s, Refusal why);

  struct RawOdometry {
    double time_s = 0.0;
    double arrived_s = 0.0;
    Se2 raw_odom_from_robot;
  };

  IntakeParams params_;
  StampMonitor scan_stamps_;
  StampMonitor odometry_stamps_;
  std::optional<RawOdometry> last_;
  std::optional<Se2> odom_from_raw_;    ///< takes the jumps out
  std::optional<double> unmeasured_s_;  ///< since the last scan that became ready
  std::deque<Stamped<Se2>> odometry_;   ///< continued, of the last hold_s and a bit
  std::deque<Waiting> waiting_;
  std::deque<ReadyScan> ready_;
  std::deque<RefusedScan> refused_;
  std::optional<std::size_t> last_beams_;
  IntakeCounts counts_;
};

}  // namespace sketchloc

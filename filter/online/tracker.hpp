#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "filter/localizer.hpp"
#include "filter/online/budget_policy.hpp"
#include "filter/online/intake.hpp"
#include "registration/odometry_feed.hpp"

namespace sketchloc {

/// How particles spread where the odometry jumped and nobody knows how the robot moved.
struct JumpSpread {
  double position_m = 0.2;         ///< at once, 1-sigma, >= 0
  double position_m_per_s = 0.5;   ///< and for each second without odometry, >= 0
  double most_position_m = 3.0;    ///< >= 0
  double heading_rad = 0.1;        ///< the same for the heading, >= 0
  double heading_rad_per_s = 0.2;  ///< >= 0
  double most_heading_rad = 1.0;   ///< >= 0
};

template <typename Visitor>
void visit_fields(JumpSpread& spread, Visitor&& visit) {
  visit("position_m", spread.position_m);
  visit("position_m_per_s", spread.position_m_per_s);
  visit("most_position_m", spread.most_position_m);
  visit("heading_rad", spread.heading_rad);
  visit("heading_rad_per_s", spread.heading_rad_per_s);
  visit("most_heading_rad", spread.most_heading_rad);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const JumpSpread& spread);

/// The online loop's own parameters, beside those of what it drives.
struct TrackerParams {
  IntakeParams intake;
  BudgetParams budget;
  JumpSpread jump;
};

template <typename Visitor>
void visit_fields(TrackerParams& params, Visitor&& visit) {
  visit("intake", params.intake);
  visit("budget", params.budget);
  visit("jump", params.jump);
}

/// Throws std::invalid_argument naming the component and field, its range and its value.
void validate(const TrackerParams& params);

/// What became of one scan.
struct TrackedScan {
  enum class Status {
    Tracked,
    NotStarted,  ///< the filter waits for a scan that tells where to start
    Refused
  };
  Status status = Status::Tracked;
  double time_s = 0.0;
  std::optional<Refusal> refusal = std::nullopt;
  std::optional<double> unmeasured_s = std::nullopt;  ///< the odometry jumped before this scan
  StepReport report;                                  ///< if Tracked
  StepPlan plan;                                      ///< what the step was allowed
  double odometry_s = 0.0;                            ///< that its refinement took
  double localizer_s = 0.0;                           ///< that the filter took
  double latency_s = 0.0;                             ///< from its arrival to now
  bool missed_deadline = false;
};

/// Seconds of a clock that never goes back.
using LoopClock = std::function<double()>;

/// Starts the localizer from a scan; false: this scan does not tell where, the next one may.
using StartLocalizer = std::function<bool(Localizer&, const Scan&)>;

/// Hears of each scan that was tracked, with the refined odometry.
using HearTracked = std::function<void(const RunStep&, const TrackedScan&)>;

/// What the online loop drives. All must outlive it.
struct TrackerParts {
  Localizer& localizer;
  OdometryFeed& odometry;
  StartLocalizer start;
  LoopClock clock;
  std::optional<double> deadline_s = std::nullopt;  ///< none: no scan is ever too late
  HearTracked hear_tracked = {};
};

/// The online loop: messages in, one result for every scan out, each within a deadline if there is
/// one: with fewer particles and registrations where time is short, and without the older scans
/// where they queue up. Does its work in the caller's thread and reads no clock but the given one.
class Tracker {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  Tracker(const TrackerParams& params, TrackerParts parts);

  void take(Message message, double arrived_s);
  /// No more messages will come: nothing waits any longer.
  void end_of_input();

  /// Does at most one scan; gives what became of scans since the last call, in order.
  std::vector<TrackedScan> work();

  /// Whether work() has something to do now.
  bool has_work() const { return !queue_.empty(); }
  /// Whether a scan waits for its odometry: then call work() again soon.
  bool waits() const { return intake_.waits(); }
  bool started() const { return started_; }

  const IntakeCounts& intake_counts() const { return intake_.counts(); }

  /// All that the scans to come depend on, but what waits in queues and what steps used to take.
  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  void drain_intake();
  void refuse_late_ones();
  TrackedScan refused(double time_s, double arrived_s, Refusal why) const;
  TrackedScan track(ReadyScan scan);
  void spread_over(double unmeasured_s);

  TrackerParams params_;
  TrackerParts parts_;
  Intake intake_;
  BudgetPolicy policy_;
  bool started_ = false;
  std::optional<double> unmeasured_s_;  ///< of scans that were refused after a jump
  std::deque<ReadyScan> queue_;
  std::vector<TrackedScan> results_;
};

}  // namespace sketchloc

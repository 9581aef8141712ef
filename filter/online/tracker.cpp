#include "filter/online/tracker.hpp"

#include <algorithm>
#include <utility>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const JumpSpread& spread) {
  require_at_least("position_m", spread.position_m, 0.0);
  require_at_least("position_m_per_s", spread.position_m_per_s, 0.0);
  require_at_least("most_position_m", spread.most_position_m, 0.0);
  require_at_least("heading_rad", spread.heading_rad, 0.0);
  require_at_least("heading_rad_per_s", spread.heading_rad_per_s, 0.0);
  require_at_least("most_heading_rad", spread.most_heading_rad, 0.0);
}

void validate(const TrackerParams& params) {
  validate_part("intake", params.intake);
  validate_part("budget", params.budget);
  validate_part("jump", params.jump);
}

Tracker::Tracker(const TrackerParams& params, TrackerParts parts)
    : params_((validate(params), params)),
      parts_(std::move(parts)),
      intake_(params.intake),
      policy_(params.budget, parts_.deadline_s) {}

void Tracker::take(Message message, double arrived_s) {
  intake_.take(std::move(message), arrived_s);
  drain_intake();
}

void Tracker::end_of_input() {
  intake_.end();
  drain_intake();
}

void Tracker::drain_intake() {
  while (const std::optional<RefusedScan> scan = intake_.next_refused()) {
    results_.push_back(refused(scan->time_s, scan->arrived_s, scan->why));
  }
  while (std::optional<ReadyScan> scan = intake_.next_ready()) {
    queue_.push_back(std::move(*scan));
  }
}

TrackedScan Tracker::refused(double time_s, double arrived_s, Refusal why) const {
  TrackedScan result;
  result.status = TrackedScan::Status::Refused;
  result.time_s = time_s;
  result.refusal = why;
  result.latency_s = parts_.clock() - arrived_s;
  return result;
}

std::vector<TrackedScan> Tracker::work() {
  intake_.wait_until(parts_.clock());
  drain_intake();
  refuse_late_ones();
  if (!queue_.empty()) {
    ReadyScan scan = std::move(queue_.front());
    queue_.pop_front();
    results_.push_back(track(std::move(scan)));
  }
  return std::exchange(results_, {});
}

/// Where scans queue up, the older ones that cannot keep the deadline whatever is done. The newest
/// one is always tracked.
void Tracker::refuse_late_ones() {
  if (!parts_.deadline_s) {
    return;
  }
  while (queue_.size() > 1 &&
         parts_.clock() - queue_.front().arrived_s + policy_.cheapest_s() > *parts_.deadline_s) {
    const ReadyScan& late = queue_.front();
    if (late.unmeasured_s) {
      unmeasured_s_ = unmeasured_s_.value_or(0.0) + *late.unmeasured_s;
    }
    results_.push_back(refused(late.step.scan.time_s, late.arrived_s, Refusal::Late));
    queue_.pop_front();
  }
}

TrackedScan Tracker::track(ReadyScan scan) {
  TrackedScan result;
  result.time_s = scan.step.scan.time_s;
  const double begin_s = parts_.clock();
  result.plan = policy_.plan(begin_s - scan.arrived_s);
  const Se2 odom_from_robot = parts_.odometry.odom_from_robot(scan.step);
  const double refined_s = parts_.clock();
  started_ = started_ || parts_.start(parts_.localizer, scan.step.scan);
  if (!started_) {
    result.status = TrackedScan::Status::NotStarted;
    result.latency_s = parts_.clock() - scan.arrived_s;
    return result;
  }
  if (scan.unmeasured_s || unmeasured_s_) {
    result.unmeasured_s = scan.unmeasured_s.value_or(0.0) + unmeasured_s_.value_or(0.0);
    unmeasured_s_.reset();
    spread_over(*result.unmeasured_s);
  }
  result.report = parts_.localizer.step(scan.step.scan, odom_from_robot, result.plan.budget);
  const double end_s = parts_.clock();
  result.odometry_s = refined_s - begin_s;
  result.localizer_s = end_s - refined_s;
  result.latency_s = end_s - scan.arrived_s;
  result.missed_deadline = parts_.deadline_s && result.latency_s > *parts_.deadline_s;
  policy_.learn({.before_s = result.odometry_s,
                 .localizer_s = result.localizer_s,
                 .particles = result.report.particles,
                 .updated = result.report.updated,
                 .looked = result.report.looked});
  if (parts_.hear_tracked) {
    parts_.hear_tracked({.scan = std::move(scan.step.scan), .odom_from_robot = odom_from_robot},
                        result);
  }
  return result;
}

void Tracker::spread_over(double unmeasured_s) {
  const JumpSpread& jump = params_.jump;
  parts_.localizer.spread(
      std::min(jump.position_m + jump.position_m_per_s * unmeasured_s, jump.most_position_m),
      std::min(jump.heading_rad + jump.heading_rad_per_s * unmeasured_s, jump.most_heading_rad));
}

void Tracker::save(StateWriter& state) const {
  intake_.save(state);
  parts_.odometry.save(state);
  state.put(started_);
  if (started_) {
    parts_.localizer.save(state);
  }
}

void Tracker::load(StateReader& state) {
  intake_.load(state);
  parts_.odometry.load(state);
  started_ = state.get<bool>();
  if (started_) {
    parts_.localizer.load(state);
  }
}

}  // namespace sketchloc

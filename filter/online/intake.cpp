#include "filter/online/intake.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/odometry.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// Where odometry begins when somebody starts it; a few messages may be lost at first.
bool begins(const Se2& raw_odom_from_robot) {
  return raw_odom_from_robot.translation().norm() < 0.05 &&
         std::abs(raw_odom_from_robot.yaw_rad()) < 0.05;
}

constexpr std::size_t kMostOdometry = 4000;  // remembered, however fast it comes

}  // namespace

void validate(const IntakeParams& params) {
  validate_part("stamps", params.stamps);
  require_at_least("wait_s", params.wait_s, 0.0);
  require_above("hold_s", params.hold_s, 0.0);
  require_above("most_speed_mps", params.most_speed_mps, 0.0);
  require_above("most_turn_radps", params.most_turn_radps, 0.0);
  require_above("jump_slack_m", params.jump_slack_m, 0.0);
  require_above("jump_slack_rad", params.jump_slack_rad, 0.0);
  require_at_least("most_waiting", static_cast<double>(params.most_waiting), 1.0);
}

Intake::Intake(const IntakeParams& params)
    : params_((validate(params), params)),
      scan_stamps_(params.stamps),
      odometry_stamps_(params.stamps) {}

void Intake::take(Message message, double arrived_s) {
  ++counts_.messages;
  if (!message.scan) {
    if (message.odom_from_robot) {
      remember_odometry(message.time_s, *message.odom_from_robot, arrived_s);
    }
  } else if (accepts_scan(*message.scan, arrived_s)) {
    count_oddities(*message.scan);
    if (message.odom_from_robot) {
      const Se2 odom = continued(message.time_s, *message.odom_from_robot, arrived_s);
      make_ready(std::move(*message.scan), odom, arrived_s);
    } else {
      waiting_.push_back({std::move(*message.scan), arrived_s});
    }
  }
  resolve(arrived_s, false);
}

bool Intake::accepts_scan(const Scan& scan, double arrived_s) {
  ++counts_.scans;
  const Stamp stamp = scan_stamps_.take(scan.time_s);
  counts_.gaps += stamp == Stamp::Ahead ? 1 : 0;
  counts_.clock_set_back += stamp == Stamp::SetBack ? 1 : 0;
  if (!is_next(stamp)) {
    refuse(scan.time_s, arrived_s,
           stamp == Stamp::Duplicate ? Refusal::Duplicate : Refusal::OutOfOrder);
  }
  return is_next(stamp);
}

void Intake::count_oddities(const Scan& scan) {
  const std::size_t beams = scan.ranges_m.size();
  counts_.beam_count_changes += last_beams_ && *last_beams_ != beams ? 1 : 0;
  last_beams_ = beams;
  bool sees = false;
  for (std::size_t beam = 0; beam < beams && !sees; ++beam) {
    sees = scan.is_return(beam);
  }
  counts_.blind_scans += sees ? 0 : 1;
}

/// The odometry without its jumps: where it moves faster than any robot, or begins anew after a
/// gap, the robot is taken to have stood.
Se2 Intake::continued(double time_s, const Se2& raw_odom_from_robot, double arrived_s) {
  if (last_) {
    const Se2 step = odometry_increment(last_->raw_odom_from_robot, raw_odom_from_robot);
    const bool forward = time_s >= last_->time_s;  // else the clock was set back
    const double seconds = forward ? time_s - last_->time_s : arrived_s - last_->arrived_s;
    const bool too_fast =
        step.translation().norm() > params_.jump_slack_m + params_.most_speed_mps * seconds ||
        std::abs(step.yaw_rad()) > params_.jump_slack_rad + params_.most_turn_radps * seconds;
    const bool restarted = seconds > params_.stamps.longest_gap_s && begins(raw_odom_from_robot) &&
                           step.translation().norm() > params_.jump_slack_m;
    if (too_fast || restarted) {
      ++counts_.odometry_jumps;
      unmeasured_s_ = unmeasured_s_.value_or(0.0) + seconds;
      odom_from_raw_ = odom_from_raw_.value_or(Se2()) * last_->raw_odom_from_robot *
                       raw_odom_from_robot.inverse();
    }
  }
  last_ = {time_s, arrived_s, raw_odom_from_robot};
  return odom_from_raw_ ? *odom_from_raw_ * raw_odom_from_robot : raw_odom_from_robot;
}

void Intake::remember_odometry(double time_s, const Se2& raw_odom_from_robot, double arrived_s) {
  const Stamp stamp = odometry_stamps_.take(time_s);
  if (!is_next(stamp)) {
    ++counts_.odometry_out_of_order;
    return;
  }
  if (stamp == Stamp::SetBack) {
    odometry_.clear();  // of another time
  }
  odometry_.push_back({time_s, continued(time_s, raw_odom_from_robot, arrived_s)});
  // A scan may be as late as it may wait, and needs one pose before it.
  const double oldest_s = time_s - 2.0 * (params_.hold_s + params_.wait_s);
  while (odometry_.size() > kMostOdometry ||
         (odometry_.size() > 2 && odometry_[1].time_s < oldest_s)) {
    odometry_.pop_front();
  }
}

void Intake::wait_until(double now_s) { resolve(now_s, false); }

void Intake::end() { resolve(0.0, true); }

void Intake::resolve(double now_s, bool nothing_more) {
  while (!waiting_.empty()) {
    Waiting& first = waiting_.front();
    const double time_s = first.scan.time_s;
    std::optional<Se2> odom_from_robot = odometry_at(time_s);
    if (!odom_from_robot) {
      const bool in_vain = nothing_more || now_s - first.arrived_s >= params_.wait_s ||
                           waiting_.size() > params_.most_waiting;
      if (!in_vain) {
        return;
      }
      odom_from_robot = odometry_held_for(time_s);
      counts_.odometry_held += odom_from_robot ? 1 : 0;
    }
    if (odom_from_robot) {
      make_ready(std::move(first.scan), *odom_from_robot, first.arrived_s);
    } else {
      refuse(time_s, first.arrived_s, Refusal::NoOdometry);
    }
    waiting_.pop_front();
  }
}

/// Between the odometry before and after; none as long as there is none after.
std::optional<Se2> Intake::odometry_at(double time_s) const {
  const auto after = std::ranges::lower_bound(odometry_, time_s, {}, &Stamped<Se2>::time_s);
  if (after == odometry_.end() || (after == odometry_.begin() && after->time_s > time_s)) {
    return std::nullopt;
  }
  if (after->time_s == time_s) {
    return after->pose;
  }
  const Stamped<Se2>& before = *std::prev(after);
  if (time_s - before.time_s > params_.hold_s && after->time_s - time_s > params_.hold_s) {
    return std::nullopt;
  }
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  return interpolate(before.pose, after->pose, share);
}

/// The odometry nearest in time, if it is near enough.
std::optional<Se2> Intake::odometry_held_for(double time_s) const {
  if (odometry_.empty()) {
    return std::nullopt;
  }
  const Stamped<Se2>& nearest =
      time_s < odometry_.front().time_s ? odometry_.front() : odometry_.back();
  return std::abs(time_s - nearest.time_s) <= params_.hold_s ? std::optional(nearest.pose)
                                                             : std::nullopt;
}

void Intake::make_ready(Scan scan, const Se2& odom_from_robot, double arrived_s) {
  ready_.push_back({.step = {.scan = std::move(scan), .odom_from_robot = odom_from_robot},
                    .arrived_s = arrived_s,
                    .unmeasured_s = std::exchange(unmeasured_s_, std::nullopt)});
}

void Intake::refuse(double time_s, double arrived_s, Refusal why) {
  counts_.duplicate_scans += why == Refusal::Duplicate ? 1 : 0;
  counts_.out_of_order_scans += why == Refusal::OutOfOrder ? 1 : 0;
  counts_.scans_without_odometry += why == Refusal::NoOdometry ? 1 : 0;
  refused_.push_back({.time_s = time_s, .arrived_s = arrived_s, .why = why});
}

namespace {

template <typename T>
std::optional<T> next_of(std::deque<T>& queue) {
  if (queue.empty()) {
    return std::nullopt;
  }
  std::optional<T> first(std::move(queue.front()));
  queue.pop_front();
  return first;
}

}  // namespace

std::optional<ReadyScan> Intake::next_ready() { return next_of(ready_); }

std::optional<RefusedScan> Intake::next_refused() { return next_of(refused_); }

void Intake::save(StateWriter& state) const {
  scan_stamps_.save(state);
  odometry_stamps_.save(state);
  state.put(odom_from_raw_);
  state.put(last_.has_value());
  if (last_) {
    state.put(last_->time_s);
    state.put(last_->raw_odom_from_robot);
  }
}

void Intake::load(StateReader& state) {
  scan_stamps_.load(state);
  odometry_stamps_.load(state);
  odom_from_raw_ = state.get_optional_se2();
  last_.reset();
  if (state.get<bool>()) {
    const double time_s = state.get_finite();
    last_ = {.time_s = time_s, .arrived_s = 0.0, .raw_odom_from_robot = state.get_se2()};
  }
}

}  // namespace sketchloc

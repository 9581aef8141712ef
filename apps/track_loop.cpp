#include "apps/track_loop.hpp"

#include <spdlog/spdlog.h>

#include <utility>
#include <vector>

#include "apps/interrupt.hpp"
#include "apps/track_lines.hpp"

namespace sketchloc {
namespace {

constexpr double kComplainEvery_s = 5.0;
constexpr double kIdle_s = 0.1;  // how long the loop does not look whether it is to end
constexpr double kWaitForOdometry_s = 0.005;

}  // namespace

TrackLoop::TrackLoop(TrackLoopParts parts)
    : parts_(std::move(parts)), complaints_(kComplainEvery_s), kept_s_(steady_now_s()) {}

std::string TrackLoop::run() {
  const double begin_s = steady_now_s();
  while (end_.empty()) {
    take_what_came();
    const bool did_something = work() || smooth();
    keep_state(false);
    if (end_was_asked_for()) {
      end_ = "interrupted";
    } else if (parts_.source.at_end() && !did_something && !parts_.tracker.has_work()) {
      end_ = "end of input";
    }
  }
  if (end_ == "end of input") {
    parts_.tracker.end_of_input();
    work_all();
    if (parts_.lagged != nullptr) {
      parts_.lagged->finish();
      write_smoothed();
    }
  }
  keep_state(true);
  return end_line(begin_s);
}

void TrackLoop::take_what_came() {
  const bool smooths = parts_.lagged != nullptr && parts_.lagged->has_work();
  const bool busy = parts_.tracker.has_work() || smooths;
  if (busy && !parts_.deadline_s) {
    return;  // whoever sends waits
  }
  const double wait_s = busy ? 0.0 : parts_.tracker.waits() ? kWaitForOdometry_s : kIdle_s;
  for (Arrival& arrival : parts_.source.receive(wait_s)) {
    take(std::move(arrival));
  }
  speak_of_intake();
}

void TrackLoop::take(Arrival arrival) {
  switch (arrival.kind) {
    case Arrival::Kind::Message:
      tally_.with_nan += arrival.had_nan ? 1 : 0;
      parts_.tracker.take(std::move(arrival.message), arrival.arrived_s);
      return;
    case Arrival::Kind::Malformed:
      ++tally_.malformed;
      say("malformed", arrival.problem + "; the message is left out");
      return;
    case Arrival::Kind::Pause:
      parts_.tracker.end_of_input();
      work_all();
      parts_.source.answered_all();
      return;
  }
}

/// Says whether there was anything to do.
bool TrackLoop::work() {
  const std::vector<TrackedScan> done = parts_.tracker.work();
  for (const TrackedScan& scan : done) {
    give_out(scan);
  }
  return !done.empty();
}

/// A bit of smoothing, where no scan waits. Says whether there was any to do.
bool TrackLoop::smooth() {
  if (parts_.lagged == nullptr || !parts_.lagged->work()) {
    return false;
  }
  write_smoothed();
  return true;
}

void TrackLoop::write_smoothed() {
  for (const std::string& line : parts_.lagged->take_lines()) {
    write(line);
  }
}

void TrackLoop::work_all() {
  while (work() && !end_was_asked_for()) {
  }
}

void TrackLoop::give_out(const TrackedScan& scan) {
  tally_.add(scan);
  write(scan_line(scan));
  speak_of(scan);
  if (const std::optional<std::string> complaint = parts_.source.complaint()) {
    say("source", *complaint);
  }
}

void TrackLoop::write(const std::string& line) {
  parts_.source.answer(line);
  if (!parts_.write(line)) {
    end_ = "nobody reads the results";
  }
}

void TrackLoop::keep_state(bool at_once) {
  if (parts_.keeper == nullptr || !parts_.tracker.started()) {
    return;
  }
  const double now_s = steady_now_s();
  if (at_once || now_s - kept_s_ >= parts_.state_every_s) {
    StateWriter state;
    parts_.tracker.save(state);
    parts_.keeper->keep(state.bytes());
    kept_s_ = now_s;
  }
  if (at_once) {
    parts_.keeper->flush();
  }
  if (const std::optional<std::string> complaint = parts_.keeper->complaint()) {
    say("state", *complaint + "; goes on without");
  }
}

void TrackLoop::say(const std::string& kind, const std::string& what) {
  if (const std::optional<std::string> text = complaints_.about(kind, what, steady_now_s())) {
    spdlog::warn("{}", *text);
  }
}

void TrackLoop::speak_of_intake() {
  const IntakeCounts& now = parts_.tracker.intake_counts();
  const auto speak = [&](std::uint64_t IntakeCounts::*count, const char* kind, const char* what) {
    if (now.*count != spoken_of_.*count) {
      say(kind, what);
    }
  };
  speak(&IntakeCounts::odometry_out_of_order, "odometry_out_of_order",
        "odometry came after later odometry, or twice; it is left out");
  speak(&IntakeCounts::odometry_jumps, "odometry_jumps",
        "the odometry jumped; the robot is taken to have stood, and its particles are spread");
  speak(&IntakeCounts::odometry_held, "odometry_held",
        "no odometry came after a scan in time; it takes the last one");
  speak(&IntakeCounts::gaps, "gaps",
        "the time stamps went ahead: messages are missing, or the clock was set");
  speak(&IntakeCounts::clock_set_back, "clock_set_back",
        "the clock of the time stamps was set back");
  speak(&IntakeCounts::beam_count_changes, "beam_count_changes",
        "scans have another number of beams than before");
  speak(&IntakeCounts::blind_scans, "blind_scans", "a scan has no return; odometry alone goes on");
  spoken_of_ = now;
}

void TrackLoop::speak_of(const TrackedScan& scan) {
  if (scan.status == TrackedScan::Status::NotStarted) {
    say("not_started", "the scan does not tell where to start; waits for the next one");
  }
  if (scan.refusal == Refusal::Duplicate) {
    say("duplicate", "a scan has the time of the last one; it is left out");
  } else if (scan.refusal == Refusal::OutOfOrder) {
    say("out_of_order", "a scan came after a later one; it is left out");
  } else if (scan.refusal == Refusal::NoOdometry) {
    say("no_odometry", "a scan came without odometry near its time; it is left out");
  } else if (scan.refusal == Refusal::Late) {
    say("late", "scans queue up: one that cannot keep the deadline is left out");
  }
  if (scan.missed_deadline) {
    say("missed_deadline", "a pose missed its deadline");
  }
  const bool degraded = scan.report.limited || scan.report.held_back;
  if (degraded && !was_degraded_) {
    say("degraded", "time is short: fewer particles or registrations, see \"degraded\"");
  }
  was_degraded_ = degraded;
}

std::string TrackLoop::end_line(double begin_s) const {
  return summary_line({.tally = tally_,
                       .intake = parts_.tracker.intake_counts(),
                       .states_written = parts_.keeper != nullptr ? parts_.keeper->written() : 0,
                       .end = end_,
                       .seconds = steady_now_s() - begin_s});
}

}  // namespace sketchloc

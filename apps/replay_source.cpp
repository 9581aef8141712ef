#include "apps/replay_source.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace sketchloc {

double ReplaySource::due_s(std::size_t step) const {
  return begin_s_ + (run_.steps[step].scan.time_s - run_.steps.front().scan.time_s) / rate_;
}

std::vector<Arrival> ReplaySource::receive(double wait_s) {
  std::vector<Arrival> arrivals;
  if (at_end()) {
    return arrivals;
  }
  if (next_ == 0) {
    begin_s_ = steady_now_s();
  }
  const auto take = [&](double arrived_s) {
    const RunStep& step = run_.steps[next_++];
    arrivals.push_back({.arrived_s = arrived_s,
                        .message = {.time_s = step.scan.time_s,
                                    .odom_from_robot = step.odom_from_robot,
                                    .scan = step.scan},
                        .problem = {}});
  };
  if (rate_ <= 0.0) {
    take(steady_now_s());
    return arrivals;
  }
  const double early_s = due_s(next_) - steady_now_s();
  if (early_s > 0.0 && wait_s > 0.0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(early_s, wait_s)));
  }
  // They arrived when they were due, even if nobody looked then.
  while (!at_end() && due_s(next_) <= steady_now_s()) {
    take(due_s(next_));
  }
  return arrivals;
}

}  // namespace sketchloc

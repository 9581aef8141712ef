#include "filter/online/stamps.hpp"

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const StampParams& params) {
  require_above("longest_gap_s", params.longest_gap_s, 0.0);
  require_above("clock_jump_s", params.clock_jump_s, 0.0);
  require_at_least("agreement", params.agreement, 1.0);
}

StampMonitor::StampMonitor(const StampParams& params) : params_((validate(params), params)) {}

Stamp StampMonitor::take(double time_s) {
  if (!last_s_ || time_s > *last_s_) {
    const bool gap = last_s_ && time_s - *last_s_ > params_.longest_gap_s;
    last_s_ = time_s;
    suspects_ = 0;
    return gap ? Stamp::Ahead : Stamp::Next;
  }
  if (time_s == *last_s_) {
    return Stamp::Duplicate;
  }
  if (*last_s_ - time_s <= params_.clock_jump_s) {
    return Stamp::OutOfOrder;
  }
  suspects_ = suspects_ > 0 && time_s > suspect_s_ ? suspects_ + 1 : 1;
  suspect_s_ = time_s;
  if (suspects_ < params_.agreement) {
    return Stamp::OutOfOrder;
  }
  last_s_ = time_s;
  suspects_ = 0;
  return Stamp::SetBack;
}

void StampMonitor::save(StateWriter& state) const { state.put(last_s_); }

void StampMonitor::load(StateReader& state) {
  last_s_ = state.get<bool>() ? std::optional(state.get_finite()) : std::nullopt;
  suspects_ = 0;
}

}  // namespace sketchloc

#pragma once

#include <optional>

#include "motion/state_bytes.hpp"

namespace sketchloc {

/// What is made of the time stamps of messages.
struct StampParams {
  double longest_gap_s = 1.0;  ///< between stamps; a longer one is reported, > 0
  double clock_jump_s = 1.0;   ///< a stamp that is earlier by more may be of a clock set back, > 0
  int agreement = 3;  ///< messages in a row that must speak for a clock that was set back, >= 1
};

template <typename Visitor>
void visit_fields(StampParams& params, Visitor&& visit) {
  visit("longest_gap_s", params.longest_gap_s);
  visit("clock_jump_s", params.clock_jump_s);
  visit("agreement", params.agreement);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const StampParams& params);

/// What a stamp says of its message.
enum class Stamp {
  Next,
  Ahead,       ///< next, but after a gap: messages are missing, or the clock was set ahead
  SetBack,     ///< next, by a clock that was set back
  Duplicate,   ///< the same as the last one
  OutOfOrder,  ///< before the last one; or the clock was set back, but that is not sure yet
};

inline bool is_next(Stamp stamp) {
  return stamp == Stamp::Next || stamp == Stamp::Ahead || stamp == Stamp::SetBack;
}

/// Follows the stamps of one stream of messages, whatever its clock does.
class StampMonitor {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  explicit StampMonitor(const StampParams& params);

  Stamp take(double time_s);

  std::optional<double> last_s() const { return last_s_; }

  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  StampParams params_;
  std::optional<double> last_s_;
  double suspect_s_ = 0.0;  ///< the last stamp that may be of a clock set back
  int suspects_ = 0;        ///< in a row, of increasing time
};

}  // namespace sketchloc

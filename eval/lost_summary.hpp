#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/filter_summary.hpp"
#include "eval/filter_trials.hpp"
#include "eval/intervals.hpp"

namespace sketchloc {

/// What counts as right, as found, and as noticed.
struct LostDefinition {
  RightDefinition right{};
  double found_lasting_m = 3.0;  ///< found: right for this way, or until the end, >= 0
  double found_way_m = 20.0;     ///< way within which it should be, > 0
  double noticed_s = 3.0;        ///< time within which being carried should be noticed, > 0
};

/// Steps whose stated probability falls into a bin.
struct StatedBin {
  double mean_stated = 0.0;
  double share_right = 0.0;
  std::size_t count = 0;
};

/// How good a stated probability of being right is, over all scored steps.
struct Reliability {
  std::vector<StatedBin> bins;  ///< ten of equal width; empty ones are left out
  double brier = 0.0;           ///< mean squared error of the probability
  double brier_of_rate = 0.0;   ///< of who always states the share that is right
  double share_right = 0.0;
  double area = 0.5;  ///< under the ROC curve: a right step is stated likelier than a wrong one
  std::size_t count = 0;
};

/// An alarm is raised where the stated probability falls below a threshold, until it is above.
struct AlarmPoint {
  double threshold = 0.0;
  double false_per_hour = 0.0;  ///< raised while right, per hour of being right
  std::optional<double> noticed =
      {};  ///< carried robots with an alarm in time, of those found before
  std::optional<double> wrong_share = {};  ///< of the time spent in wrong places under an alarm
};

/// One line: a method on all sets of a kind.
struct LostRow {
  std::string kind;
  std::string method;
  std::size_t sets = 0;
  std::size_t trials = 0;
  Reliability reliability = {};
  std::vector<AlarmPoint> alarms = {};
  double right_hours = 0.0;
  std::size_t events = 0;        ///< global starts, and carried robots that were right before
  std::size_t found = 0;         ///< of the events, within found_way_m
  Interval found_interval = {};  ///< of the share, Wilson
  std::optional<double>
      median_found_way_m;  ///< never counts as infinite; none: more than half never
};

/// One row for each kind and method, in the order of their first trials; and one more for each
/// method over all kinds, called `all`.
std::vector<LostRow> summarize_lost(std::span<const FilterTrial> trials,
                                    const LostDefinition& lost = {});

/// The way from an event (the first step of the errors) until the robot is found; none: never.
std::optional<double> found_after_m(std::span<const StepError> errors,
                                    const LostDefinition& lost = {});

std::string lost_json(std::span<const LostRow> rows);
std::string lost_markdown(std::span<const LostRow> rows);

}  // namespace sketchloc

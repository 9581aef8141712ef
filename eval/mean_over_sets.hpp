#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/intervals.hpp"

namespace sketchloc {

/// A mean with its 95 % interval. Trials on one set resemble each other, so the interval is a
/// bootstrap over the sets' means; none for a single set.
struct MeanOverSets {
  double mean = 0.0;
  std::optional<Interval> interval;
};

/// What a trial on a set gave.
struct ValueOfSet {
  std::string set;
  double value = 0.0;
};

/// The mean over all values, at least one.
MeanOverSets mean_over_sets(std::span<const ValueOfSet> values, Rng& rng);

/// The mean over the sets that both have of the mean of `values` minus that of `others` there; zero
/// where they have none in common.
MeanOverSets mean_difference_over_sets(std::span<const ValueOfSet> values,
                                       std::span<const ValueOfSet> others, Rng& rng);

/// A measure of each of the trials, with their sets.
template <typename Trial, typename Measure>
std::vector<ValueOfSet> measured(const std::vector<const Trial*>& trials, const Measure& measure) {
  std::vector<ValueOfSet> values;
  values.reserve(trials.size());
  for (const Trial* trial : trials) {
    values.push_back({.set = trial->set, .value = measure(*trial)});
  }
  return values;
}

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <span>

#include "motion/random.hpp"

namespace sketchloc {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// Confidence interval of a success rate. [Wilson27] Needs successes <= trials; without trials the
/// rate may be anything: [0, 1].
Interval wilson_interval(std::size_t successes, std::size_t trials, double confidence = 0.95);

struct BootstrapParams {
  enum class Statistic { Mean, Median };
  Statistic statistic = Statistic::Mean;
  double confidence = 0.95;      ///< in (0, 1)
  std::size_t resamples = 2000;  ///< >= 1
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const BootstrapParams& params);

/// Percentile bootstrap interval of the mean or median of independent values (at least one).
/// [Efron93]
Interval bootstrap_interval(std::span<const double> values, const BootstrapParams& params,
                            Rng& rng);

/// Interval of the mean or median of first - second, for methods that ran on the same inputs:
/// the spread between the inputs drops out. Zero outside the interval means they differ.
Interval paired_interval(std::span<const double> first, std::span<const double> second,
                         const BootstrapParams& params, Rng& rng);

}  // namespace sketchloc

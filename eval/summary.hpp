#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace sketchloc {

/// The five numbers that are published of a list of errors, in the unit of the errors.
struct ErrorSummary {
  double mean = 0.0;
  double median = 0.0;  ///< mean of the two middle values where their number is even
  double rmse = 0.0;
  double p90 = 0.0;  ///< linear between order statistics, see quantile()
  double max = 0.0;
  std::size_t count = 0;
};

/// None for an empty list. The errors must be finite.
std::optional<ErrorSummary> summarize(std::span<const double> errors);

/// The same errors in another unit, e.g. degrees for radians; factor >= 0.
ErrorSummary scaled(const ErrorSummary& summary, double factor);

/// The value below which a share (0..1) of the values lies, linear between order statistics
/// (position share * (n - 1)). Needs at least one value.
double quantile(std::span<const double> values, double share);

/// How many of the values are at most `bound`, in [0, 1]; 0 for an empty list.
double share_within(std::span<const double> values, double bound);

}  // namespace sketchloc

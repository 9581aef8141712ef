#pragma once

#include <cmath>
#include <span>

namespace sketchloc::testing {

/// Sample mean and variance with their standard errors, for tolerances of five standard errors.
struct SampleMoments {
  double mean = 0.0;
  double variance = 0.0;
  double mean_error = 0.0;      ///< one standard error of the mean
  double variance_error = 0.0;  ///< one standard error of the variance, from the fourth moment
};

inline SampleMoments sample_moments(std::span<const double> values) {
  const double count = static_cast<double>(values.size());
  SampleMoments result;
  for (const double value : values) {
    result.mean += value / count;
  }
  double fourth = 0.0;
  for (const double value : values) {
    const double square = (value - result.mean) * (value - result.mean);
    result.variance += square / count;
    fourth += square * square / count;
  }
  result.mean_error = std::sqrt(result.variance / count);
  result.variance_error = std::sqrt((fourth - result.variance * result.variance) / count);
  return result;
}

}  // namespace sketchloc::testing

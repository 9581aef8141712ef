#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "eval/intervals.hpp"

namespace sketchloc {

/// Normalised estimation error squared, e^T P^-1 e: what an honest covariance makes a chi-square
/// variable with e.size() degrees of freedom. None where P is not positive definite.
/// [BarShalom01 5.4]
std::optional<double> nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance);

/// Many values of one filter against what an honest one gives.
struct NeesSummary {
  double mean = 0.0;          ///< `degrees` for an honest filter, more for an overconfident one
  double degrees = 0.0;       ///< degrees of freedom of one value
  Interval mean_band;         ///< where the mean of as many independent values lies
  double share_inside = 0.0;  ///< values at most `single_bound`, in [0, 1]
  double single_bound = 0.0;  ///< chi-square quantile of the confidence
  std::size_t count = 0;
};

/// None without values. The band of the mean assumes independent values: take them from separate
/// runs; the steps of one run are correlated and stray further.
std::optional<NeesSummary> summarize_nees(std::span<const double> values, double degrees,
                                          double confidence = 0.95);

}  // namespace sketchloc

#include "eval/nees.hpp"

#include <Eigen/Cholesky>
#include <numeric>

#include "eval/distributions.hpp"
#include "eval/summary.hpp"
#include "motion/check.hpp"

namespace sketchloc {

std::optional<double> nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  check(covariance.rows() == error.size() && covariance.cols() == error.size(),
        "error and covariance must have one size");
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  if (factor.info() != Eigen::Success) {
    return std::nullopt;
  }
  const double value = error.dot(factor.solve(error));
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<NeesSummary> summarize_nees(std::span<const double> values, double degrees,
                                          double confidence) {
  if (values.empty()) {
    return std::nullopt;
  }
  const double count = static_cast<double>(values.size());
  const double tail = 0.5 * (1.0 - confidence);
  // The sum of n independent chi-square values with d degrees has n d degrees.
  const Interval band{.low = chi_square_quantile(tail, count * degrees) / count,
                      .high = chi_square_quantile(1.0 - tail, count * degrees) / count};
  const double bound = chi_square_quantile(confidence, degrees);
  return NeesSummary{.mean = std::accumulate(values.begin(), values.end(), 0.0) / count,
                     .degrees = degrees,
                     .mean_band = band,
                     .share_inside = share_within(values, bound),
                     .single_bound = bound,
                     .count = values.size()};
}

}  // namespace sketchloc

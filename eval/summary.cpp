#include "eval/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "motion/check.hpp"
#include "motion/quantile.hpp"

namespace sketchloc {
namespace {

std::vector<double> sorted_copy(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted;
}

}  // namespace

std::optional<ErrorSummary> summarize(std::span<const double> errors) {
  if (errors.empty()) {
    return std::nullopt;
  }
  check(std::ranges::all_of(errors, [](double e) { return std::isfinite(e); }),
        "errors to summarize must be finite");
  const std::vector<double> sorted = sorted_copy(errors);
  const double count = static_cast<double>(sorted.size());
  const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  const double squares = std::inner_product(sorted.begin(), sorted.end(), sorted.begin(), 0.0);
  return ErrorSummary{.mean = sum / count,
                      .median = quantile_of_sorted(sorted, 0.5),
                      .rmse = std::sqrt(squares / count),
                      .p90 = quantile_of_sorted(sorted, 0.9),
                      .max = sorted.back(),
                      .count = sorted.size()};
}

ErrorSummary scaled(const ErrorSummary& summary, double factor) {
  return {.mean = summary.mean * factor,
          .median = summary.median * factor,
          .rmse = summary.rmse * factor,
          .p90 = summary.p90 * factor,
          .max = summary.max * factor,
          .count = summary.count};
}

double quantile(std::span<const double> values, double share) {
  return quantile_of_sorted(sorted_copy(values), share);
}

double share_within(std::span<const double> values, double bound) {
  if (values.empty()) {
    return 0.0;
  }
  const auto within = std::ranges::count_if(values, [&](double value) { return value <= bound; });
  return static_cast<double>(within) / static_cast<double>(values.size());
}

}  // namespace sketchloc

#include "eval/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "eval/distributions.hpp"
#include "eval/summary.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

double statistic_of(std::span<const double> values, BootstrapParams::Statistic statistic) {
  if (statistic == BootstrapParams::Statistic::Median) {
    return quantile(values, 0.5);
  }
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Interval wilson_interval(std::size_t successes, std::size_t trials, double confidence) {
  check(successes <= trials, "more successes than trials");
  check(confidence > 0.0 && confidence < 1.0, "a confidence lies in (0, 1)");
  if (trials == 0) {
    return {.low = 0.0, .high = 1.0};
  }
  const double n = static_cast<double>(trials);
  const double rate = static_cast<double>(successes) / n;
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  const double shrink = 1.0 + z * z / n;
  const double centre = (rate + z * z / (2.0 * n)) / shrink;
  const double half = z / shrink * std::sqrt(rate * (1.0 - rate) / n + z * z / (4.0 * n * n));
  return {.low = successes == 0 ? 0.0 : std::max(0.0, centre - half),
          .high = successes == trials ? 1.0 : std::min(1.0, centre + half)};
}

void validate(const BootstrapParams& params) {
  require_in_range("confidence", params.confidence, 0.0, 1.0);
  require_at_least("resamples", static_cast<double>(params.resamples), 1.0);
}

Interval bootstrap_interval(std::span<const double> values, const BootstrapParams& params,
                            Rng& rng) {
  check(!values.empty(), "a bootstrap needs a value");
  validate(params);
  std::vector<double> resample(values.size());
  std::vector<double> statistics(params.resamples);
  const double count = static_cast<double>(values.size());
  for (double& statistic : statistics) {
    for (double& value : resample) {
      value = values[static_cast<std::size_t>(uniform(rng) * count)];
    }
    statistic = statistic_of(resample, params.statistic);
  }
  const double tail = 0.5 * (1.0 - params.confidence);
  return {.low = quantile(statistics, tail), .high = quantile(statistics, 1.0 - tail)};
}

Interval paired_interval(std::span<const double> first, std::span<const double> second,
                         const BootstrapParams& params, Rng& rng) {
  check(first.size() == second.size(), "paired values come in equal numbers");
  std::vector<double> differences(first.size());
  std::ranges::transform(first, second, differences.begin(), std::minus<>());
  return bootstrap_interval(differences, params, rng);
}

}  // namespace sketchloc

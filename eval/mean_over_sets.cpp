#include "eval/mean_over_sets.hpp"

#include <map>

#include "eval/summary.hpp"

namespace sketchloc {
namespace {

std::map<std::string, double> means_of(std::span<const ValueOfSet> values) {
  std::map<std::string, std::vector<double>> by_set;
  for (const ValueOfSet& value : values) {
    by_set[value.set].push_back(value.value);
  }
  std::map<std::string, double> means;
  for (const auto& [set, some] : by_set) {
    means[set] = summarize(some)->mean;
  }
  return means;
}

std::optional<Interval> interval_of(const std::vector<double>& means, Rng& rng) {
  return means.size() > 1 ? std::optional(bootstrap_interval(means, {}, rng)) : std::nullopt;
}

}  // namespace

MeanOverSets mean_over_sets(std::span<const ValueOfSet> values, Rng& rng) {
  std::vector<double> all;
  for (const ValueOfSet& value : values) {
    all.push_back(value.value);
  }
  std::vector<double> means;
  for (const auto& [set, mean] : means_of(values)) {
    means.push_back(mean);
  }
  return {.mean = summarize(all)->mean, .interval = interval_of(means, rng)};
}

MeanOverSets mean_difference_over_sets(std::span<const ValueOfSet> values,
                                       std::span<const ValueOfSet> others, Rng& rng) {
  const std::map<std::string, double> other_means = means_of(others);
  std::vector<double> differences;
  for (const auto& [set, mean] : means_of(values)) {
    if (const auto same = other_means.find(set); same != other_means.end()) {
      differences.push_back(mean - same->second);
    }
  }
  if (differences.empty()) {
    return {};
  }
  return {.mean = summarize(differences)->mean, .interval = interval_of(differences, rng)};
}

}  // namespace sketchloc

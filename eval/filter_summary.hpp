#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "eval/filter_trials.hpp"
#include "eval/mean_over_sets.hpp"
#include "eval/summary.hpp"

namespace sketchloc {

/// One line of a filter suite: a method on all sets of a kind, all seeds together. Means are over
/// trials; their intervals are bootstraps over the sets, whose seeds resemble each other.
struct FilterRow {
  std::string kind;
  std::string method;
  std::size_t sets = 0;
  std::size_t trials = 0;
  MeanOverSets mean_error_m;
  MeanOverSets median_error_m;  ///< mean over the trials' medians
  MeanOverSets mean_heading_rad;
  MeanOverSets share_within_1_m;
  MeanOverSets share_within_2_m;
  MeanOverSets share_ever_lost;          ///< of the trials
  MeanOverSets share_lost_at_end;        ///< of the trials
  std::optional<double> nees_inside_95;  ///< of the steps; none where no covariance is stated
  /// Survival: way driven, m, and share of the trials not lost by then.
  std::vector<std::pair<double, double>> survival;
  /// Way driven and the median error of all steps around there, m.
  std::vector<std::pair<double, double>> error_by_way;
};

/// One row for each kind and method, in the order of their first trials.
std::vector<FilterRow> summarize_filter(std::span<const FilterTrial> trials,
                                        std::uint64_t seed = 1);

/// Mean error of one method minus that of another on the same sets, over the seeds of each, m.
struct FilterDifference {
  std::string kind;
  std::string method;
  std::string other;
  MeanOverSets mean_error_m;
  MeanOverSets share_within_2_m;
};

/// Of one method against each other one.
std::vector<FilterDifference> compare_filter(std::span<const FilterTrial> trials,
                                             const std::string& method, std::uint64_t seed = 1);

/// metrics.json, a table for a document, and a self-contained page.
std::string filter_json(std::span<const FilterRow> rows,
                        std::span<const FilterDifference> differences);
std::string filter_markdown(std::span<const FilterRow> rows);
std::string filter_page_html(const std::string& title, const std::string& caption,
                             std::span<const FilterRow> rows,
                             std::span<const FilterDifference> differences);

}  // namespace sketchloc

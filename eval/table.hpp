#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/intervals.hpp"
#include "eval/sketch_errors.hpp"

namespace sketchloc {

/// Runs of one method on one data set, one per seed.
struct RunSet {
  std::string data_set;
  std::string method;
  std::vector<SketchErrors> runs;  ///< each with a scored step
};

/// A figure over the runs of a set, with its 95 % interval where there are runs to tell.
struct TableCell {
  std::optional<double> value;  ///< none: never, or nothing to say
  std::optional<Interval> interval;
};

/// One line of a table of results.
struct TableRow {
  std::string data_set;
  std::string method;
  std::size_t runs = 0;
  TableCell share_within_1_m;    ///< mean over the runs, in [0, 1]
  TableCell share_within_2_m;    ///< mean
  TableCell worst_within_2_m;    ///< the least of the runs
  TableCell median_error_m;      ///< mean of the runs' medians
  TableCell median_heading_rad;  ///< mean of the runs' medians
  TableCell first_loss_s;        ///< median; none where half of the runs are never lost
  TableCell share_lost_at_end;   ///< of the runs, Wilson interval
};

/// Means carry bootstrap intervals, rates Wilson intervals. Empty sets are left out.
std::vector<TableRow> summarize_runs(std::span<const RunSet> sets, std::uint64_t seed = 1);

/// A table for a document.
std::string table_markdown(std::span<const TableRow> rows);

/// The same as a page of its own, self-contained, with the intervals drawn.
std::string table_html(const std::string& title, const std::string& caption,
                       std::span<const TableRow> rows);

}  // namespace sketchloc

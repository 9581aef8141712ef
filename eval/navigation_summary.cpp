#include "eval/navigation_summary.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/detail/page_table.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/intervals.hpp"
#include "eval/summary.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;
using detail::fixed;

/// Trials of one kind by one method.
struct Row {
  std::string kind;
  std::string method;
  std::size_t trials = 0;
  std::size_t successes = 0;
  std::size_t passed = 0;  ///< the goal within the bound at some time
  std::size_t collisions = 0;
  std::size_t seen_collisions = 0;
  double spl = 0.0;  ///< sum of success * shortest / driven
  std::vector<double> errors_m = {};
  std::vector<double> cycle_ms = {};
  std::vector<double> processor_ms = {};
};

std::vector<Row> rows_of(std::span<const NavigationTrial> trials, double success_m) {
  std::vector<Row> rows;
  for (const NavigationTrial& trial : trials) {
    auto row = std::ranges::find_if(
        rows, [&](const Row& one) { return one.kind == trial.kind && one.method == trial.method; });
    if (row == rows.end()) {
      rows.push_back({.kind = trial.kind, .method = trial.method});
      row = rows.end() - 1;
    }
    const bool success = trial.success(success_m);
    ++row->trials;
    row->successes += success ? 1 : 0;
    row->passed += trial.nearest_m <= success_m ? 1 : 0;
    row->collisions += trial.collisions > 0 ? 1 : 0;
    row->seen_collisions += trial.seen_collisions > 0 ? 1 : 0;
    row->spl += success ? trial.shortest_m / std::max(trial.way_m, trial.shortest_m) : 0.0;
    row->errors_m.push_back(trial.error_m);
    row->cycle_ms.insert(row->cycle_ms.end(), trial.cycle_ms.begin(), trial.cycle_ms.end());
    row->processor_ms.insert(row->processor_ms.end(), trial.cycle_processor_ms.begin(),
                             trial.cycle_processor_ms.end());
  }
  return rows;
}

std::vector<std::string> heads() {
  return {"kind",         "method",       "success",          "within bound on the way",
          "SPL",          "error p50 m",  "with collision",   "of these seen",
          "cycle p50 ms", "cycle p99 ms", "processor p50 ms", "processor p99 ms"};
}

std::string rate_text(std::size_t count, std::size_t trials) {
  const Interval interval = wilson_interval(count, trials);
  return std::to_string(count) + "/" + std::to_string(trials) + " = " +
         fixed(100.0 * static_cast<double>(count) / static_cast<double>(trials), 0) + " % [" +
         fixed(100.0 * interval.low, 0) + ", " + fixed(100.0 * interval.high, 0) + "]";
}

std::vector<std::string> cells_of(const Row& row) {
  return {row.kind,
          row.method,
          rate_text(row.successes, row.trials),
          rate_text(row.passed, row.trials),
          fixed(row.spl / static_cast<double>(row.trials), 2),
          fixed(quantile(row.errors_m, 0.5), 2),
          std::to_string(row.collisions),
          std::to_string(row.seen_collisions),
          fixed(quantile(row.cycle_ms, 0.5), 1),
          fixed(quantile(row.cycle_ms, 0.99), 1),
          fixed(quantile(row.processor_ms, 0.5), 1),
          fixed(quantile(row.processor_ms, 0.99), 1)};
}

/// Drives that failed, and what plays each of them back: a drive is the same for the same seed.
std::string failures_html(std::span<const NavigationTrial> trials, double success_m,
                          std::uint64_t seed) {
  std::vector<std::vector<std::string>> lines;
  for (const NavigationTrial& trial : trials) {
    if (!trial.success(success_m)) {
      const std::string plan = trial.set.substr(trial.set.find(' ') + 1);
      lines.push_back({trial.set, trial.method, fixed(trial.error_m, 2), fixed(trial.nearest_m, 2),
                       "sketchloc navigate --person " + trial.kind + " --plan " + plan +
                           " --method " + trial.method + " --seed " + std::to_string(seed) +
                           " --out DIR"});
    }
  }
  return "<p>Each of these commands makes a page that plays the drive back. Parameters that were "
         "given to the suite have to be given again.</p>" +
         detail::results_table({"drive", "method", "error m", "nearest m", "see it again by"},
                               lines);
}

}  // namespace

std::string navigation_suite_json(std::span<const NavigationTrial> trials, double success_m) {
  Json rows = Json::array();
  for (const Row& row : rows_of(trials, success_m)) {
    const Interval interval = wilson_interval(row.successes, row.trials);
    rows.push_back({{"kind", row.kind},
                    {"method", row.method},
                    {"trials", row.trials},
                    {"successes", row.successes},
                    {"success_interval_95", {interval.low, interval.high}},
                    {"within_bound_on_the_way", row.passed},
                    {"spl", row.spl / static_cast<double>(row.trials)},
                    {"error_median_m", quantile(row.errors_m, 0.5)},
                    {"trials_with_collision", row.collisions},
                    {"trials_with_seen_collision", row.seen_collisions},
                    {"cycle_p50_ms", quantile(row.cycle_ms, 0.5)},
                    {"cycle_p99_ms", quantile(row.cycle_ms, 0.99)},
                    {"cycle_processor_p50_ms", quantile(row.processor_ms, 0.5)},
                    {"cycle_processor_p99_ms", quantile(row.processor_ms, 0.99)}});
  }
  return Json{{"success_m", success_m}, {"rows", rows}}.dump(2) + "\n";
}

std::string navigation_suite_markdown(std::span<const NavigationTrial> trials, double success_m) {
  const auto joined = [](const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) {
      line += " " + cell + " |";
    }
    return line + "\n";
  };
  std::string text = joined(heads()) + joined(std::vector<std::string>(heads().size(), "---"));
  for (const Row& row : rows_of(trials, success_m)) {
    text += joined(cells_of(row));
  }
  return text;
}

std::string navigation_suite_html(std::span<const NavigationTrial> trials, double success_m,
                                  std::uint64_t seed) {
  std::vector<std::vector<std::string>> lines;
  for (const Row& row : rows_of(trials, success_m)) {
    lines.push_back(cells_of(row));
  }
  return detail::open_page("Ablation: navigation") +
         "<header><h1>Ablation: navigation</h1><p class=\"note\">Success: the robot stops within " +
         fixed(success_m, 2) +
         " m of the goal. Rates with 95 % Wilson intervals. SPL: success weighted by shortest over "
         "driven way.</p></header><main>" +
         detail::section("Drives to a goal in a drawing", detail::results_table(heads(), lines)) +
         detail::section("Drives that failed", failures_html(trials, success_m, seed)) + "</main>" +
         detail::close_page();
}

}  // namespace sketchloc

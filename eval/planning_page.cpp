#include <map>
#include <nlohmann/json.hpp>

#include "eval/detail/page_table.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/intervals.hpp"
#include "eval/planning_suite.hpp"
#include "eval/summary.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using detail::fixed;

/// One method against the baseline, where both found a way.
struct Row {
  std::string method;
  std::size_t questions = 0;
  std::size_t found = 0;
  std::size_t missed = 0;  ///< the baseline found one
  std::vector<double> length_ratio = {};
  std::vector<double> least_clearance_gain_m = {};
  std::vector<double> mean_clearance_gain_m = {};
  std::vector<double> first_ms = {};
  std::vector<double> first_ratio = {};
  std::vector<double> ms = {};
};

void add_to(Row& row, const PlanningTrial& trial, const PlanningTrial& baseline) {
  ++row.questions;
  row.found += trial.found ? 1 : 0;
  row.missed += baseline.found && !trial.found ? 1 : 0;
  if (!trial.found || !baseline.found) {
    return;
  }
  row.length_ratio.push_back(trial.figures.length_m / baseline.figures.length_m);
  row.first_ratio.push_back(trial.first_length_m / baseline.figures.length_m);
  row.least_clearance_gain_m.push_back(trial.figures.least_clearance_m -
                                       baseline.figures.least_clearance_m);
  row.mean_clearance_gain_m.push_back(trial.figures.mean_clearance_m -
                                      baseline.figures.mean_clearance_m);
  row.first_ms.push_back(trial.first_ms);
  row.ms.push_back(trial.ms);
}

std::vector<Row> rows_of(std::span<const PlanningTrial> trials) {
  std::vector<Row> rows;
  std::map<std::pair<int, int>, const PlanningTrial*> baselines;
  std::map<std::string, std::size_t> places;
  for (const PlanningTrial& trial : trials) {
    if (trial.method == kPlanningBaseline) {
      baselines[{trial.drawing, trial.query}] = &trial;
    }
    const auto [place, is_new] = places.try_emplace(trial.method, rows.size());
    if (is_new) {
      rows.push_back({.method = trial.method});
    }
    add_to(rows[place->second], trial, *baselines.at({trial.drawing, trial.query}));
  }
  return rows;
}

struct Figure {
  double value = 0.0;
  Interval interval = {};
};

Figure mean_of(const std::vector<double>& values, std::uint64_t seed) {
  if (values.empty()) {
    return {};
  }
  Rng rng = make_rng(seed);
  return {summarize(values)->mean, bootstrap_interval(values, {}, rng)};
}

std::string text_of(const Figure& figure, int decimals) {
  return fixed(figure.value, decimals) + " [" + fixed(figure.interval.low, decimals) + ", " +
         fixed(figure.interval.high, decimals) + "]";
}

double share_of(const std::vector<double>& values, double share) {
  return values.empty() ? 0.0 : quantile(values, share);
}

std::vector<std::string> heads() {
  return {"method",       "found",           "missed",         "length, ratio",
          "ratio p95",    "least clearance", "mean clearance", "first way ms",
          "first ms p95", "first ratio p50", "end ms p95"};
}

std::vector<std::string> cells_of(const Row& row, std::uint64_t seed) {
  return {row.method,
          std::to_string(row.found) + "/" + std::to_string(row.questions),
          std::to_string(row.missed),
          text_of(mean_of(row.length_ratio, seed), 4),
          fixed(share_of(row.length_ratio, 0.95), 4),
          text_of(mean_of(row.least_clearance_gain_m, seed), 3),
          text_of(mean_of(row.mean_clearance_gain_m, seed), 3),
          fixed(share_of(row.first_ms, 0.5), 2),
          fixed(share_of(row.first_ms, 0.95), 2),
          fixed(share_of(row.first_ratio, 0.5), 3),
          fixed(share_of(row.ms, 0.95), 1)};
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += " " + cell + " |";
  }
  return line + "\n";
}

nlohmann::ordered_json to_json(const Figure& figure) {
  return {{"mean", figure.value}, {"interval_95", {figure.interval.low, figure.interval.high}}};
}

constexpr const char* kCaption =
    "Against the search on the grid with shortcuts, on the same questions: ratio of lengths, gain "
    "of clearance in m (positive: farther from strokes); means with 95 % intervals. Times are wall "
    "clock.";

}  // namespace

std::string planning_suite_json(std::span<const PlanningTrial> trials, std::uint64_t seed) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Row& row : rows_of(trials)) {
    rows.push_back({{"method", row.method},
                    {"questions", row.questions},
                    {"found", row.found},
                    {"missed", row.missed},
                    {"length_ratio", to_json(mean_of(row.length_ratio, seed))},
                    {"length_ratio_p95", share_of(row.length_ratio, 0.95)},
                    {"length_ratio_max", share_of(row.length_ratio, 1.0)},
                    {"least_clearance_gain_m", to_json(mean_of(row.least_clearance_gain_m, seed))},
                    {"least_clearance_gain_min_m", share_of(row.least_clearance_gain_m, 0.0)},
                    {"mean_clearance_gain_m", to_json(mean_of(row.mean_clearance_gain_m, seed))},
                    {"first_ratio_median", share_of(row.first_ratio, 0.5)},
                    {"first_ms_median", share_of(row.first_ms, 0.5)},
                    {"first_ms_p95", share_of(row.first_ms, 0.95)},
                    {"ms_p95", share_of(row.ms, 0.95)}});
  }
  return nlohmann::ordered_json{{"rows", rows}}.dump(2) + "\n";
}

std::string planning_trials_csv(std::span<const PlanningTrial> trials) {
  std::string text =
      "drawing,query,method,found,length_m,least_clearance_m,mean_clearance_m,first_length_m,"
      "first_ms,ms\n";
  for (const PlanningTrial& trial : trials) {
    text += std::to_string(trial.drawing) + "," + std::to_string(trial.query) + "," + trial.method +
            "," + (trial.found ? "1" : "0");
    for (const double value :
         {trial.figures.length_m, trial.figures.least_clearance_m, trial.figures.mean_clearance_m,
          trial.first_length_m, trial.first_ms, trial.ms}) {
      text += ",";
      append_number(text, value);
    }
    text += "\n";
  }
  return text;
}

std::string planning_suite_markdown(std::span<const PlanningTrial> trials, std::uint64_t seed) {
  std::string text = joined(heads()) + joined(std::vector<std::string>(heads().size(), "---"));
  for (const Row& row : rows_of(trials)) {
    text += joined(cells_of(row, seed));
  }
  return text;
}

std::string planning_suite_html(std::span<const PlanningTrial> trials, std::uint64_t seed) {
  std::vector<std::vector<std::string>> lines;
  for (const Row& row : rows_of(trials)) {
    lines.push_back(cells_of(row, seed));
  }
  return detail::open_page("Ablation: planning") +
         "<header><h1>Ablation: planning</h1><p class=\"note\">" + kCaption +
         "</p></header><main>" +
         detail::section("Ways in drawings", detail::results_table(heads(), lines)) + "</main>" +
         detail::close_page();
}

}  // namespace sketchloc

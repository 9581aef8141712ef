#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "eval/detail/page_table.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/intervals.hpp"
#include "eval/topology_suite.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using detail::fixed;

/// Trials that differ in their seed alone.
struct Row {
  std::string part;
  std::string row;
  double level = 0.0;
  std::string set;
  std::vector<const TopologyTrial*> trials = {};
};

std::vector<Row> rows_of(std::span<const TopologyTrial> trials) {
  std::vector<Row> rows;
  std::map<std::tuple<std::string, std::string, double, std::string>, std::size_t> places;
  for (const TopologyTrial& trial : trials) {
    const auto [place, is_new] =
        places.try_emplace({trial.part, trial.row, trial.level, trial.set}, rows.size());
    if (is_new) {
      rows.push_back(
          {.part = trial.part, .row = trial.row, .level = trial.level, .set = trial.set});
    }
    rows[place->second].trials.push_back(&trial);
  }
  return rows;
}

template <typename Measure>
MeanOverSets mean_of(const Row& row, const Measure& measure) {
  std::vector<double> values;
  MeanOverSets mean;
  for (const TopologyTrial* trial : row.trials) {
    values.push_back(measure(*trial));
    mean.mean += values.back() / static_cast<double>(row.trials.size());
  }
  if (values.size() > 1) {
    Rng rng = make_rng(1);
    mean.interval = bootstrap_interval(values, {}, rng);
  }
  return mean;
}

MeanOverSets unaligned_m(const Row& row) {
  return mean_of(row, [](const TopologyTrial& trial) { return trial.errors.unaligned.mean; });
}
MeanOverSets first_pose_m(const Row& row) {
  return mean_of(row, [](const TopologyTrial& trial) { return trial.errors.first_pose.mean; });
}
MeanOverSets se2_m(const Row& row) {
  return mean_of(row, [](const TopologyTrial& trial) { return trial.errors.se2.rmse; });
}

std::string pairs_text(const Row& row) {
  PairCounts sum;
  for (const TopologyTrial* trial : row.trials) {
    sum.used += trial->pairs.used;
    sum.right += trial->pairs.right;
  }
  return sum.used == 0 ? "" : std::to_string(sum.right) + " of " + std::to_string(sum.used);
}

std::vector<std::string> cells(const Row& row) {
  return {row.part,
          row.row,
          row.level > 0.0 ? detail::percent(row.level) : "",
          row.set,
          std::to_string(row.trials.size()),
          detail::with_interval(unaligned_m(row), 1.0, 2),
          detail::with_interval(first_pose_m(row), 1.0, 2),
          detail::with_interval(se2_m(row), 1.0, 2),
          pairs_text(row)};
}

/// How well scans tell the kinds of places: one row for each name of sets. Each log counts once.
struct LabelRow {
  std::string set;
  std::vector<ConfusionMatrix> logs = {};

  int poses() const {
    int sum = 0;
    for (const ConfusionMatrix& log : logs) {
      sum += log.count();
    }
    return sum;
  }
  ConfusionMatrix together() const {
    ConfusionMatrix sum = logs.front();
    for (std::size_t i = 1; i < logs.size(); ++i) {
      for (std::size_t right = 0; right < sum.given_of_right.size(); ++right) {
        std::ranges::transform(sum.given_of_right[right], logs[i].given_of_right[right],
                               sum.given_of_right[right].begin(), std::plus<>());
      }
    }
    return sum;
  }
  MeanOverSets accuracy() const {
    std::vector<double> values;
    for (const ConfusionMatrix& log : logs) {
      values.push_back(log.accuracy());
    }
    MeanOverSets mean;
    mean.mean = together().accuracy();
    if (values.size() > 1) {
      Rng rng = make_rng(1);
      mean.interval = bootstrap_interval(values, {}, rng);
    }
    return mean;
  }
};

std::vector<LabelRow> label_rows(std::span<const TopologyTrial> trials) {
  std::vector<LabelRow> rows;
  for (const TopologyTrial& trial : trials) {
    if (!trial.labels || trial.row.starts_with("raw")) {
      continue;  // the same labels again
    }
    auto row = std::ranges::find(rows, trial.set, &LabelRow::set);
    if (row == rows.end()) {
      row = rows.insert(rows.end(), {.set = trial.set});
    }
    row->logs.push_back(*trial.labels);
  }
  return rows;
}

std::vector<std::string> label_heads() {
  std::vector<std::string> heads = {"runs", "n", "poses", "right %"};
  for (const auto& [name, label] : names_of(PlaceLabel{})) {
    heads.push_back(std::string(name) + ", recall / precision %");
  }
  return heads;
}

std::vector<std::string> cells(const LabelRow& row) {
  std::vector<std::string> cells = {row.set, std::to_string(row.logs.size()),
                                    std::to_string(row.poses()),
                                    detail::with_interval(row.accuracy(), 100.0, 1)};
  const ConfusionMatrix all = row.together();
  for (const auto& [name, label] : names_of(PlaceLabel{})) {
    const auto index = static_cast<std::size_t>(label);
    cells.push_back(fixed(100.0 * all.recall(index), 1) + " / " +
                    fixed(100.0 * all.precision(index), 1));
  }
  return cells;
}

std::vector<std::vector<std::string>> label_table(std::span<const TopologyTrial> trials) {
  std::vector<std::vector<std::string>> table;
  for (const LabelRow& row : label_rows(trials)) {
    table.push_back(cells(row));
  }
  return table;
}

const std::vector<std::string> kHeads = {
    "part",          "row",        "wrong", "run", "n", "as it is, mean m", "first pose, mean m",
    "SE(2), RMSE m", "pairs right"};

nlohmann::ordered_json to_json(const MeanOverSets& mean) {
  nlohmann::ordered_json json = {{"mean", mean.mean}};
  if (mean.interval) {
    json["low"] = mean.interval->low;
    json["high"] = mean.interval->high;
  }
  return json;
}

}  // namespace

std::string topology_suite_json(std::span<const TopologyTrial> trials) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Row& row : rows_of(trials)) {
    json.push_back({{"part", row.part},
                    {"row", row.row},
                    {"level", row.level},
                    {"set", row.set},
                    {"trials", row.trials.size()},
                    {"unaligned_mean_m", to_json(unaligned_m(row))},
                    {"first_pose_mean_m", to_json(first_pose_m(row))},
                    {"se2_rmse_m", to_json(se2_m(row))}});
  }
  return json.dump(2) + "\n";
}

std::string topology_suite_markdown(std::span<const TopologyTrial> trials) {
  const auto line = [](const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) {
      text += " " + cell + " |";
    }
    return text + "\n";
  };
  const auto head = [&](const std::vector<std::string>& cells) {
    return line(cells) + line(std::vector<std::string>(cells.size(), "---"));
  };
  std::string text = head(kHeads);
  for (const Row& row : rows_of(trials)) {
    text += line(cells(row));
  }
  if (const auto labels = label_table(trials); !labels.empty()) {
    text += "\nKinds of places, told by scans:\n\n" + head(label_heads());
    for (const std::vector<std::string>& row : labels) {
      text += line(row);
    }
  }
  return text;
}

std::string topology_suite_html(std::span<const TopologyTrial> trials) {
  std::map<std::string, std::vector<std::vector<std::string>>> parts;
  for (const Row& row : rows_of(trials)) {
    parts[row.part].push_back(cells(row));
  }
  const std::vector<std::pair<std::string, std::string>> kTexts = {
      {"stages",
       "How much of the topology is used, each row with those above it. The odometry is as it was "
       "recorded. incremental: as if the robot were driving. Published means over four runs "
       "[Topo20]: 11.57 unoptimised, 4.54 manhattan, 2.84 with loops, 2.08 dense, 1.82 feedback, "
       "1.45 incremental."},
      {"log",
       "Logs: odometry refined by its scans (matched) or as the wheels measured it (raw); alone, "
       "with the true kinds of places, and with kinds of places and loop closures by scans."},
      {"odometry", "The odometry is made anew from the reference, by a model of wheels."},
      {"wrong pairs",
       "Nodes of one label far apart are tied together as if they were one place, until they are "
       "this share of all pairs; each row is a kernel."},
      {"wrong labels", "This share of the poses has a wrong label, in runs of eight."}};
  std::string body;
  for (const auto& [part, text] : kTexts) {
    if (const auto found = parts.find(part); found != parts.end()) {
      body += detail::section(part,
                              "<p>" + text + "</p>" + detail::results_table(kHeads, found->second));
    }
  }
  if (const auto labels = label_table(trials); !labels.empty()) {
    body += detail::section("kinds of places", "<p>Told by scans, against the true ones.</p>" +
                                                   detail::results_table(label_heads(), labels));
  }
  return detail::open_page("Topology") + "<header><h1>Topology</h1><p class=\"note\">Distances " +
         "from the reference; in brackets 95&#160;% intervals over seeds.</p></header><main>" +
         body + "</main>" + detail::close_page();
}

std::string topology_trials_csv(std::span<const TopologyTrial> trials) {
  std::string text =
      "part,row,level,set,seed,unaligned_mean_m,first_pose_mean_m,se2_rmse_m,pairs_used,pairs_"
      "right,"
      "pairs_all\n";
  for (const TopologyTrial& trial : trials) {
    text += trial.part + "," + trial.row + "," + number_text(trial.level) + "," + trial.set + "," +
            std::to_string(trial.seed);
    for (const double value :
         {trial.errors.unaligned.mean, trial.errors.first_pose.mean, trial.errors.se2.rmse}) {
      text += "," + number_text(value);
    }
    text += "," + std::to_string(trial.pairs.used) + "," + std::to_string(trial.pairs.right) + "," +
            std::to_string(trial.pairs.all) + "\n";
  }
  return text;
}

}  // namespace sketchloc

#include "eval/filter_summary.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "eval/detail/grouped.hpp"
#include "eval/detail/page_table.hpp"
#include "eval/detail/text.hpp"
#include "eval/distributions.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using detail::with_interval;
using Json = nlohmann::ordered_json;
using Trials = std::vector<const FilterTrial*>;
using Measure = std::function<double(const FilterTrial&)>;

constexpr double kDegrees = deg_from_rad(1.0);
constexpr int kCurvePoints = 40;

std::vector<double> errors_m(const FilterTrial& trial) {
  std::vector<double> values;
  for (const StepError& error : trial.errors) {
    values.push_back(error.translation_m);
  }
  return values;
}

double mean_error_m(const FilterTrial& trial) { return summarize(errors_m(trial))->mean; }
double within_2_m(const FilterTrial& trial) { return share_within(errors_m(trial), 2.0); }

double way_of(const FilterTrial& trial) { return trial.errors.back().driven_m; }

/// The way after which a trial is lost; none: never.
std::optional<double> lost_after_m(const FilterTrial& trial) {
  const std::optional<StepError> loss = first_loss(trial.errors);
  return loss ? std::optional(loss->driven_m) : std::nullopt;
}

/// Kaplan-Meier: a trial that ends counts as long as it ran.
std::vector<std::pair<double, double>> survival_of(const Trials& trials) {
  struct End {
    double way_m = 0.0;
    bool lost = false;
  };
  std::vector<End> ends;
  for (const FilterTrial* trial : trials) {
    const std::optional<double> lost_m = lost_after_m(*trial);
    ends.push_back({lost_m.value_or(way_of(*trial)), lost_m.has_value()});
  }
  std::ranges::sort(ends, {}, &End::way_m);
  std::vector<std::pair<double, double>> curve = {{0.0, 1.0}};
  double share = 1.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    curve.emplace_back(ends[i].way_m, share);
    if (ends[i].lost) {
      share *= 1.0 - 1.0 / static_cast<double>(ends.size() - i);
      curve.emplace_back(ends[i].way_m, share);
    }
  }
  return curve;
}

std::vector<std::pair<double, double>> error_by_way(const Trials& trials) {
  double longest_m = 0.0;
  for (const FilterTrial* trial : trials) {
    longest_m = std::max(longest_m, way_of(*trial));
  }
  const double bin_m = std::max(longest_m, 1e-9) / kCurvePoints;
  std::vector<std::vector<double>> bins(kCurvePoints);
  for (const FilterTrial* trial : trials) {
    for (const StepError& error : trial->errors) {
      const auto bin = std::min(static_cast<std::size_t>(error.driven_m / bin_m), bins.size() - 1);
      bins[bin].push_back(error.translation_m);
    }
  }
  std::vector<std::pair<double, double>> curve;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (!bins[i].empty()) {
      curve.emplace_back((static_cast<double>(i) + 0.5) * bin_m, quantile(bins[i], 0.5));
    }
  }
  return curve;
}

std::optional<double> nees_inside_95(const Trials& trials) {
  std::vector<double> nees;
  for (const FilterTrial* trial : trials) {
    for (const StepError& error : trial->errors) {
      if (error.position_nees && error.stated_sigma_m > 0.0) {
        nees.push_back(*error.position_nees);
      }
    }
  }
  return nees.empty() ? std::nullopt
                      : std::optional(share_within(nees, chi_square_quantile(0.95, 2)));
}

FilterRow row_of(const Trials& trials, Rng& rng) {
  FilterRow row;
  row.kind = trials.front()->kind;
  row.method = trials.front()->method;
  row.trials = trials.size();
  std::map<std::string, int> sets;
  for (const FilterTrial* trial : trials) {
    ++sets[trial->set];
  }
  row.sets = sets.size();
  const auto mean = [&](const Measure& measure) {
    return mean_over_sets(measured(trials, measure), rng);
  };
  row.mean_error_m = mean(mean_error_m);
  row.median_error_m =
      mean([](const FilterTrial& trial) { return quantile(errors_m(trial), 0.5); });
  row.mean_heading_rad = mean([](const FilterTrial& trial) {
    double sum = 0.0;
    for (const StepError& error : trial.errors) {
      sum += error.heading_rad;
    }
    return sum / static_cast<double>(trial.errors.size());
  });
  row.share_within_1_m =
      mean([](const FilterTrial& trial) { return share_within(errors_m(trial), 1.0); });
  row.share_within_2_m = mean(within_2_m);
  row.share_ever_lost =
      mean([](const FilterTrial& trial) { return lost_after_m(trial) ? 1.0 : 0.0; });
  row.share_lost_at_end = mean([](const FilterTrial& trial) {
    return trial.errors.back().translation_m > LossDefinition{}.bound_m ? 1.0 : 0.0;
  });
  row.nees_inside_95 = nees_inside_95(trials);
  row.survival = survival_of(trials);
  row.error_by_way = error_by_way(trials);
  return row;
}

/// By kind and method; trials without a scored step say nothing.
std::vector<Trials> grouped(std::span<const FilterTrial> trials) {
  Trials scored;
  for (const FilterTrial& trial : trials) {
    if (!trial.errors.empty()) {
      scored.push_back(&trial);
    }
  }
  return detail::grouped(
      scored, [](const FilterTrial& trial) { return std::pair(trial.kind, trial.method); });
}

Json json_of(const MeanOverSets& mean, double factor) {
  Json json{{"mean", factor * mean.mean}};
  json["interval_95"] =
      mean.interval ? Json{factor * mean.interval->low, factor * mean.interval->high} : Json();
  return json;
}

Json json_of(const std::vector<std::pair<double, double>>& curve) {
  Json json = Json::array();
  for (const auto& [x, y] : curve) {
    json.push_back({x, y});
  }
  return json;
}

}  // namespace

std::vector<FilterRow> summarize_filter(std::span<const FilterTrial> trials, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  std::vector<FilterRow> rows;
  for (const Trials& group : grouped(trials)) {
    rows.push_back(row_of(group, rng));
  }
  return rows;
}

std::vector<FilterDifference> compare_filter(std::span<const FilterTrial> trials,
                                             const std::string& method, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  const std::vector<Trials> groups = grouped(trials);
  std::vector<FilterDifference> differences;
  for (const Trials& other : groups) {
    const auto mine = std::ranges::find_if(groups, [&](const Trials& group) {
      return group.front()->method == method && group.front()->kind == other.front()->kind;
    });
    if (mine == groups.end() || other.front()->method == method) {
      continue;
    }
    const auto minus = [&](const Measure& measure) {
      return mean_difference_over_sets(measured(*mine, measure), measured(other, measure), rng);
    };
    differences.push_back({.kind = other.front()->kind,
                           .method = method,
                           .other = other.front()->method,
                           .mean_error_m = minus(mean_error_m),
                           .share_within_2_m = minus(within_2_m)});
  }
  return differences;
}

std::string filter_json(std::span<const FilterRow> rows,
                        std::span<const FilterDifference> differences) {
  Json json;
  json["rows"] = Json::array();
  json["differences"] = Json::array();
  for (const FilterRow& row : rows) {
    json["rows"].push_back(
        {{"kind", row.kind},
         {"method", row.method},
         {"sets", row.sets},
         {"trials", row.trials},
         {"mean_error_m", json_of(row.mean_error_m, 1.0)},
         {"median_error_m", json_of(row.median_error_m, 1.0)},
         {"mean_heading_error_deg", json_of(row.mean_heading_rad, kDegrees)},
         {"share_within_1_m", json_of(row.share_within_1_m, 1.0)},
         {"share_within_2_m", json_of(row.share_within_2_m, 1.0)},
         {"share_ever_lost", json_of(row.share_ever_lost, 1.0)},
         {"share_lost_at_end", json_of(row.share_lost_at_end, 1.0)},
         {"nees_inside_95", row.nees_inside_95 ? Json(*row.nees_inside_95) : Json()},
         {"survival", json_of(row.survival)},
         {"error_by_way", json_of(row.error_by_way)}});
  }
  for (const FilterDifference& difference : differences) {
    json["differences"].push_back(
        {{"kind", difference.kind},
         {"method", difference.method},
         {"minus", difference.other},
         {"mean_error_m", json_of(difference.mean_error_m, 1.0)},
         {"share_within_2_m", json_of(difference.share_within_2_m, 1.0)}});
  }
  return json.dump(2) + "\n";
}

std::string filter_markdown(std::span<const FilterRow> rows) {
  std::string text =
      "| runs | method | n | mean cm | median cm | heading deg | within 1 m % | within 2 m % | "
      "ever "
      "lost % | lost at the end % | in its 95 % |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const FilterRow& row : rows) {
    text += "| " + row.kind + " | " + row.method + " | " + std::to_string(row.trials) + " | " +
            with_interval(row.mean_error_m, 100.0, 0) + " | " +
            with_interval(row.median_error_m, 100.0, 0) + " | " +
            with_interval(row.mean_heading_rad, kDegrees, 1) + " | " +
            with_interval(row.share_within_1_m, 100.0, 0) + " | " +
            with_interval(row.share_within_2_m, 100.0, 0) + " | " +
            with_interval(row.share_ever_lost, 100.0, 0) + " | " +
            with_interval(row.share_lost_at_end, 100.0, 0) + " | " +
            (row.nees_inside_95 ? detail::fixed(100.0 * *row.nees_inside_95, 0) : "") + " |\n";
  }
  return text;
}

}  // namespace sketchloc

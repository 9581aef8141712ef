#include "eval/lost_summary.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "eval/detail/text.hpp"
#include "eval/summary.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;
using Trials = std::vector<const FilterTrial*>;

constexpr std::size_t kBins = 10;
constexpr std::array<double, 15> kThresholds = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2,
                                                0.3,   0.4,   0.5,   0.6,  0.7,  0.8,  0.9};
constexpr double kHourS = 3600.0;

/// A step's stated probability, and whether it was right.
struct Stated {
  double probability = 0.0;
  bool right = false;
};

/// Area under the ROC curve, ties half: by ranks.
double area_under(std::vector<Stated> all) {
  std::ranges::sort(all, {}, &Stated::probability);
  double area = 0.0;
  double wrong_below = 0.0;
  double right_count = 0.0;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    double right = 0.0;
    double wrong = 0.0;
    for (; end < all.size() && all[end].probability == all[i].probability; ++end) {
      (all[end].right ? right : wrong) += 1.0;
    }
    area += right * (wrong_below + 0.5 * wrong);
    wrong_below += wrong;
    right_count += right;
    i = end;
  }
  return right_count > 0.0 && wrong_below > 0.0 ? area / (right_count * wrong_below) : 0.5;
}

Reliability reliability_of(const std::vector<Stated>& all) {
  Reliability result{.bins = {}, .count = all.size()};
  struct Sums {
    double stated = 0.0;
    double right = 0.0;
    std::size_t count = 0;
  };
  std::array<Sums, kBins> bins;
  for (const Stated& one : all) {
    const auto bin = static_cast<std::size_t>(one.probability * kBins);
    Sums& sums = bins[std::min(bin, kBins - 1)];
    const double right = one.right ? 1.0 : 0.0;
    sums.stated += one.probability;
    sums.right += right;
    ++sums.count;
    const double off = one.probability - right;
    result.brier += off * off;
    result.share_right += right;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(all.size(), 1));
  result.brier /= count;
  result.share_right /= count;
  result.brier_of_rate = result.share_right * (1.0 - result.share_right);
  result.area = area_under(all);
  for (const Sums& sums : bins) {
    if (sums.count > 0) {
      const auto n = static_cast<double>(sums.count);
      result.bins.push_back(
          {.mean_stated = sums.stated / n, .share_right = sums.right / n, .count = sums.count});
    }
  }
  return result;
}

/// The scored errors from a step on.
std::span<const StepError> from_step(const FilterTrial& trial, std::size_t step) {
  const auto first = std::ranges::lower_bound(trial.errors, step, {}, &StepError::step);
  return {first, trial.errors.end()};
}

/// Whether the robot was right when it was carried away.
bool was_right(const FilterTrial& trial, const LostDefinition& lost) {
  const auto after = from_step(trial, *trial.carried_at);
  const auto before = trial.errors.size() - after.size();
  return before > 0 && !after.empty() && is_right(trial.errors[before - 1], lost.right);
}

/// The errors from each event on: a global start, or being carried away.
std::vector<std::span<const StepError>> events_of(const Trials& trials,
                                                  const LostDefinition& lost) {
  std::vector<std::span<const StepError>> events;
  for (const FilterTrial* trial : trials) {
    if (trial->start == FilterStart::Anywhere && !trial->errors.empty()) {
      events.push_back(trial->errors);
    } else if (trial->carried_at && was_right(*trial, lost)) {
      events.push_back(from_step(*trial, *trial->carried_at));
    }
  }
  return events;
}

double time_s(const FilterTrial& trial, std::size_t i) {
  return i + 1 < trial.errors.size() ? trial.errors[i + 1].time_s - trial.errors[i].time_s : 0.0;
}

/// Whether an alarm is on at a step, or was raised by then.
bool noticed_in_time(std::span<const StepError> after, double threshold,
                     const LostDefinition& lost) {
  for (const StepError& error : after) {
    if (error.time_s > after.front().time_s + lost.noticed_s) {
      break;
    }
    if (error.localized_probability < threshold) {
      return true;
    }
  }
  return false;
}

AlarmPoint alarm_point(const Trials& trials, double threshold, const LostDefinition& lost) {
  double false_alarms = 0.0;
  double right_s = 0.0;
  double wrong_s = 0.0;
  double wrong_under_alarm_s = 0.0;
  double carried = 0.0;
  double noticed = 0.0;
  for (const FilterTrial* trial : trials) {
    bool before = trial->start != FilterStart::Reference;  // the first alarm of a lost start is due
    for (std::size_t i = 0; i < trial->errors.size(); ++i) {
      const StepError& error = trial->errors[i];
      const bool alarm = error.localized_probability < threshold;
      const bool right = is_right(error, lost.right);
      (right ? right_s : wrong_s) += time_s(*trial, i);
      wrong_under_alarm_s += !right && alarm ? time_s(*trial, i) : 0.0;
      false_alarms += right && alarm && !before ? 1.0 : 0.0;
      before = alarm;
    }
    if (trial->carried_at && was_right(*trial, lost)) {
      carried += 1.0;
      noticed += noticed_in_time(from_step(*trial, *trial->carried_at), threshold, lost) ? 1 : 0;
    }
  }
  AlarmPoint point{.threshold = threshold,
                   .false_per_hour = right_s > 0.0 ? kHourS * false_alarms / right_s : 0.0};
  if (carried > 0.0) {
    point.noticed = noticed / carried;
  }
  if (wrong_s > 0.0) {
    point.wrong_share = wrong_under_alarm_s / wrong_s;
  }
  return point;
}

LostRow row_of(const Trials& trials, const LostDefinition& lost) {
  LostRow row;
  row.kind = trials.front()->kind;
  row.method = trials.front()->method;
  row.trials = trials.size();
  std::map<std::string, int> sets;
  std::vector<Stated> stated;
  for (const FilterTrial* trial : trials) {
    ++sets[trial->set];
    for (std::size_t i = 0; i < trial->errors.size(); ++i) {
      const StepError& error = trial->errors[i];
      const bool right = is_right(error, lost.right);
      stated.push_back({error.localized_probability, right});
      row.right_hours += right ? time_s(*trial, i) / kHourS : 0.0;
    }
  }
  row.sets = sets.size();
  row.reliability = reliability_of(stated);
  for (const double threshold : kThresholds) {
    row.alarms.push_back(alarm_point(trials, threshold, lost));
  }
  std::vector<double> ways;
  for (const std::span<const StepError> event : events_of(trials, lost)) {
    const std::optional<double> way = found_after_m(event, lost);
    ways.push_back(way.value_or(std::numeric_limits<double>::infinity()));
    row.found += way && *way <= lost.found_way_m ? 1U : 0U;
  }
  row.events = ways.size();
  row.found_interval = wilson_interval(row.found, row.events);
  if (!ways.empty()) {
    std::ranges::sort(ways);
    const double median = ways[(ways.size() - 1) / 2];
    row.median_found_way_m = median < 1e9 ? std::optional(median) : std::nullopt;
  }
  return row;
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json json_of(const LostRow& row) {
  Json json{{"kind", row.kind},
            {"method", row.method},
            {"sets", row.sets},
            {"trials", row.trials},
            {"brier", row.reliability.brier},
            {"brier_of_rate", row.reliability.brier_of_rate},
            {"share_right", row.reliability.share_right},
            {"roc_area", row.reliability.area},
            {"steps", row.reliability.count},
            {"right_hours", row.right_hours},
            {"events", row.events},
            {"found", row.found},
            {"found_interval_95", {row.found_interval.low, row.found_interval.high}},
            {"median_found_way_m", or_null(row.median_found_way_m)}};
  json["reliability"] = Json::array();
  for (const StatedBin& bin : row.reliability.bins) {
    json["reliability"].push_back(
        {{"stated", bin.mean_stated}, {"right", bin.share_right}, {"steps", bin.count}});
  }
  json["alarms"] = Json::array();
  for (const AlarmPoint& point : row.alarms) {
    json["alarms"].push_back({{"threshold", point.threshold},
                              {"false_per_hour", point.false_per_hour},
                              {"noticed", or_null(point.noticed)},
                              {"wrong_share", or_null(point.wrong_share)}});
  }
  return json;
}

std::string percent(const std::optional<double>& share) {
  return share ? detail::fixed(100.0 * *share, 0) : std::string();
}

const AlarmPoint& point_at(const LostRow& row, double threshold) {
  return *std::ranges::find(row.alarms, threshold, &AlarmPoint::threshold);
}

}  // namespace

std::optional<double> found_after_m(std::span<const StepError> errors, const LostDefinition& lost) {
  std::optional<double> since_m;
  for (const StepError& error : errors) {
    if (!is_right(error, lost.right)) {
      since_m.reset();
      continue;
    }
    since_m = since_m.value_or(error.driven_m - errors.front().driven_m);
    if (error.driven_m - errors.front().driven_m - *since_m >= lost.found_lasting_m) {
      return since_m;
    }
  }
  return since_m;
}

std::vector<LostRow> summarize_lost(std::span<const FilterTrial> trials,
                                    const LostDefinition& lost) {
  std::vector<std::pair<std::pair<std::string, std::string>, Trials>> groups;
  const auto add = [&](const std::string& kind, const FilterTrial& trial) {
    const std::pair key(kind, trial.method);
    auto place = std::ranges::find(groups, key, [](const auto& group) { return group.first; });
    if (place == groups.end()) {
      place = groups.insert(groups.end(), {key, {}});
    }
    place->second.push_back(&trial);
  };
  for (const bool all : {false, true}) {
    for (const FilterTrial& trial : trials) {
      // Who states no covariance states no probability either.
      if (!trial.errors.empty() && trial.errors.front().stated_sigma_m > 0.0) {
        add(all ? "all" : trial.kind, trial);
      }
    }
  }
  std::vector<LostRow> rows;
  for (const auto& [key, group] : groups) {
    rows.push_back(row_of(group, lost));
    rows.back().kind = key.first;
  }
  return rows;
}

std::string lost_json(std::span<const LostRow> rows) {
  Json json = Json::array();
  for (const LostRow& row : rows) {
    json.push_back(json_of(row));
  }
  return json.dump(2) + "\n";
}

std::string lost_markdown(std::span<const LostRow> rows) {
  constexpr double kThreshold = 0.1;
  std::string text =
      "| runs | method | n | right % | Brier | of the rate | ROC area | found in 20 m | median way "
      "m | alarms below 0.1: false per hour | carried noticed in 3 s % | wrong time under alarm % "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const LostRow& row : rows) {
    const AlarmPoint& alarm = point_at(row, kThreshold);
    const std::string found =
        row.events == 0 ? std::string()
                        : std::to_string(row.found) + " of " + std::to_string(row.events) + " [" +
                              detail::fixed(100.0 * row.found_interval.low, 0) + ", " +
                              detail::fixed(100.0 * row.found_interval.high, 0) + "] %";
    text += "| " + row.kind + " | " + row.method + " | " + std::to_string(row.trials) + " | " +
            detail::fixed(100.0 * row.reliability.share_right, 0) + " | " +
            detail::fixed(row.reliability.brier, 3) + " | " +
            detail::fixed(row.reliability.brier_of_rate, 3) + " | " +
            detail::fixed(row.reliability.area, 3) + " | " + found + " | " +
            (row.median_found_way_m ? detail::fixed(*row.median_found_way_m, 1) : std::string()) +
            " | " + detail::fixed(alarm.false_per_hour, 1) + " | " + percent(alarm.noticed) +
            " | " + percent(alarm.wrong_share) + " |\n";
  }
  return text;
}

}  // namespace sketchloc

#include "eval/registration_summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "eval/detail/grouped.hpp"
#include "eval/detail/page_table.hpp"
#include "eval/detail/text.hpp"
#include "eval/distributions.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using detail::with_interval;
using Trials = std::vector<const RegistrationTrial*>;
using Figure = std::function<double(const RegistrationTrial&)>;
using Json = nlohmann::ordered_json;

constexpr double kRight_m = 0.5;
constexpr double kRight_deg = 15.0;
constexpr std::size_t kReliabilityBins = 10;
constexpr std::size_t kFewest = 10;  ///< trials in a bin that says something

double position_of(const RegistrationTrial& trial) { return trial.error.position_m; }
double heading_of(const RegistrationTrial& trial) { return trial.error.heading_rad; }

std::vector<double> values_of(const Trials& trials, const Figure& figure) {
  std::vector<double> values;
  for (const RegistrationTrial* trial : trials) {
    values.push_back(figure(*trial));
  }
  return values;
}

std::optional<Coverage> coverage_of(const Trials& trials) {
  std::vector<double> pose;
  std::vector<double> position;
  for (const RegistrationTrial* trial : trials) {
    if (trial->nees_pose && trial->nees_position) {
      pose.push_back(*trial->nees_pose);
      position.push_back(*trial->nees_position);
    }
  }
  if (pose.empty()) {
    return std::nullopt;
  }
  return Coverage{.pose_68 = share_within(pose, student_t_quantile(0.68, 3, kErrorDegrees)),
                  .pose_95 = share_within(pose, student_t_quantile(0.95, 3, kErrorDegrees)),
                  .position_68 = share_within(position, student_t_quantile(0.68, 2, kErrorDegrees)),
                  .position_95 = share_within(position, student_t_quantile(0.95, 2, kErrorDegrees)),
                  .count = pose.size()};
}

std::vector<ReliabilityBin> reliability_of(const Trials& trials) {
  std::array<Trials, kReliabilityBins> bins;
  for (const RegistrationTrial* trial : trials) {
    const auto bin = static_cast<std::size_t>(trial->inlier_probability * kReliabilityBins);
    bins[std::min(bin, kReliabilityBins - 1)].push_back(trial);
  }
  std::vector<ReliabilityBin> result;
  for (const Trials& bin : bins) {
    if (bin.size() < kFewest) {
      continue;
    }
    const auto right = static_cast<std::size_t>(std::ranges::count_if(
        bin, [](const RegistrationTrial* trial) { return is_right(*trial); }));
    const auto stated = values_of(bin, [](const auto& trial) { return trial.inlier_probability; });
    result.push_back({.mean_stated = summarize(stated)->mean,
                      .share_right = static_cast<double>(right) / static_cast<double>(bin.size()),
                      .interval = wilson_interval(right, bin.size()),
                      .count = bin.size()});
  }
  return result;
}

double brier(const RegistrationTrial& trial) {
  const double off = trial.inlier_probability - (is_right(trial) ? 1.0 : 0.0);
  return off * off;
}

bool is_nearer(const RegistrationTrial& trial) {
  return trial.error.position_m < trial.prior.position_m;
}

RegistrationRow row_of(const Trials& trials, Rng& rng) {
  const RegistrationTrial& first = *trials.front();
  RegistrationRow row;
  row.kind = first.kind;
  row.protocol = first.protocol;
  row.method = first.method;
  row.trials = trials.size();
  std::map<std::string, int> sets;
  for (const RegistrationTrial* trial : trials) {
    ++sets[trial->set];
    row.failures += trial->found ? 0 : 1;
  }
  row.sets = sets.size();
  const auto summary = [&](const Figure& figure) { return *summarize(values_of(trials, figure)); };
  row.prior_m = summary([](const auto& trial) { return trial.prior.position_m; });
  row.position_m = summary(position_of);
  row.heading_rad = summary(heading_of);
  const auto mean = [&](const Figure& figure) {
    return mean_over_sets(measured(trials, figure), rng);
  };
  row.mean_position_m = mean(position_of);
  row.mean_heading_rad = mean(heading_of);
  row.share_nearer = mean([](const auto& trial) { return is_nearer(trial) ? 1.0 : 0.0; });
  row.share_right = mean([](const auto& trial) { return is_right(trial) ? 1.0 : 0.0; });
  row.log_scale_error_median =
      summary([](const auto& trial) { return std::abs(trial.log_scale_error); }).median;
  row.alignment_gain =
      mean([](const auto& trial) { return trial.alignment - trial.prior_alignment; });
  row.share_aligned =
      mean([](const auto& trial) { return trial.alignment > trial.prior_alignment ? 1.0 : 0.0; });
  row.coverage = coverage_of(trials);
  row.reliability = reliability_of(trials);
  row.inlier_brier = summary(brier).mean;
  row.median_ms = summary([](const auto& trial) { return trial.milliseconds; }).median;
  return row;
}

/// By kind, protocol and method.
std::vector<Trials> grouped(std::span<const RegistrationTrial> trials) {
  Trials all;
  for (const RegistrationTrial& trial : trials) {
    all.push_back(&trial);
  }
  return detail::grouped(all, [](const RegistrationTrial& trial) {
    return std::tuple(trial.kind, trial.protocol, trial.method);
  });
}

Json json_of(const MeanOverSets& mean, double factor) {
  Json json{{"mean", factor * mean.mean}};
  json["interval_95"] =
      mean.interval ? Json{factor * mean.interval->low, factor * mean.interval->high} : Json();
  return json;
}

Json json_of(const ErrorSummary& summary) {
  return {{"mean", summary.mean},
          {"median", summary.median},
          {"rmse", summary.rmse},
          {"p90", summary.p90},
          {"max", summary.max}};
}

Json json_of(const RegistrationRow& row) {
  constexpr double kDegrees = deg_from_rad(1.0);
  Json json{{"kind", row.kind},
            {"protocol", row.protocol},
            {"method", row.method},
            {"sets", row.sets},
            {"trials", row.trials},
            {"failures", row.failures},
            {"prior_error_m", json_of(row.prior_m)},
            {"translation_error_m", json_of(row.position_m)},
            {"heading_error_deg", json_of(scaled(row.heading_rad, kDegrees))},
            {"mean_translation_error_m", json_of(row.mean_position_m, 1.0)},
            {"mean_heading_error_deg", json_of(row.mean_heading_rad, kDegrees)},
            {"share_nearer_than_prior", json_of(row.share_nearer, 1.0)},
            {"share_right", json_of(row.share_right, 1.0)},
            {"alignment_gain", json_of(row.alignment_gain, 1.0)},
            {"share_better_aligned", json_of(row.share_aligned, 1.0)},
            {"log_scale_error_median", row.log_scale_error_median},
            {"inlier_brier", row.inlier_brier}};
  if (row.coverage) {
    json["coverage"] = {{"pose_68", row.coverage->pose_68},
                        {"pose_95", row.coverage->pose_95},
                        {"position_68", row.coverage->position_68},
                        {"position_95", row.coverage->position_95}};
    for (const ReliabilityBin& bin : row.reliability) {
      json["reliability"].push_back({{"stated", bin.mean_stated},
                                     {"right", bin.share_right},
                                     {"interval_95", {bin.interval.low, bin.interval.high}},
                                     {"trials", bin.count}});
    }
  }
  return json;
}

}  // namespace

bool is_right(const RegistrationTrial& trial) {
  return trial.error.position_m < kRight_m && trial.error.heading_rad < rad_from_deg(kRight_deg);
}

std::vector<RegistrationRow> summarize_registration(std::span<const RegistrationTrial> trials,
                                                    std::uint64_t seed) {
  Rng rng = make_rng(seed);
  std::vector<RegistrationRow> rows;
  for (const Trials& group : grouped(trials)) {
    rows.push_back(row_of(group, rng));
  }
  return rows;
}

std::vector<RegistrationDifference> compare_registration(std::span<const RegistrationTrial> trials,
                                                         const std::string& method,
                                                         std::uint64_t seed) {
  using Question = std::tuple<std::string, std::string, std::size_t>;  // protocol, set, step
  std::map<Question, const RegistrationTrial*> answers;
  for (const RegistrationTrial& trial : trials) {
    if (trial.method == method) {
      answers[{trial.protocol, trial.set, trial.index}] = &trial;
    }
  }
  Rng rng = make_rng(seed);
  std::vector<RegistrationDifference> differences;
  for (const Trials& others : grouped(trials)) {
    const auto mean_minus_other = [&](const Figure& figure) {
      const auto difference = [&](const RegistrationTrial& other) {
        return figure(*answers.at({other.protocol, other.set, other.index})) - figure(other);
      };
      return mean_over_sets(measured(others, difference), rng);
    };
    const RegistrationTrial& first = *others.front();
    if (first.method == method || !answers.contains({first.protocol, first.set, first.index})) {
      continue;
    }
    differences.push_back({.kind = first.kind,
                           .protocol = first.protocol,
                           .method = method,
                           .other = first.method,
                           .position_m = mean_minus_other(position_of),
                           .heading_rad = mean_minus_other(heading_of)});
  }
  return differences;
}

std::string registration_json(std::span<const RegistrationRow> rows,
                              std::span<const RegistrationDifference> differences) {
  Json json;
  json["rows"] = Json::array();
  json["differences"] = Json::array();
  for (const RegistrationRow& row : rows) {
    json["rows"].push_back(json_of(row));
  }
  for (const RegistrationDifference& difference : differences) {
    json["differences"].push_back(
        {{"kind", difference.kind},
         {"protocol", difference.protocol},
         {"method", difference.method},
         {"minus", difference.other},
         {"translation_error_m", json_of(difference.position_m, 1.0)},
         {"heading_error_deg", json_of(difference.heading_rad, deg_from_rad(1.0))}});
  }
  return json.dump(2) + "\n";
}

std::string registration_timing_json(std::span<const RegistrationRow> rows) {
  Json json = Json::array();
  for (const RegistrationRow& row : rows) {
    json.push_back({{"kind", row.kind},
                    {"protocol", row.protocol},
                    {"method", row.method},
                    {"median_ms", row.median_ms}});
  }
  return json.dump(2) + "\n";
}

std::string registration_markdown(std::span<const RegistrationRow> rows) {
  std::string text =
      "| drawings | priors | method | trials | prior median cm | error mean cm | median cm | p90 "
      "cm | "
      "heading mean deg | median deg | nearer % | aligned % | ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const RegistrationRow& row : rows) {
    text += "| " + row.kind + " | " + row.protocol + " | " + row.method + " | " +
            std::to_string(row.trials) + " | " + detail::fixed(100.0 * row.prior_m.median, 0) +
            " | " + with_interval(row.mean_position_m, 100.0, 1) + " | " +
            detail::fixed(100.0 * row.position_m.median, 1) + " | " +
            detail::fixed(100.0 * row.position_m.p90, 0) + " | " +
            with_interval(row.mean_heading_rad, deg_from_rad(1.0), 1) + " | " +
            detail::fixed(deg_from_rad(row.heading_rad.median), 1) + " | " +
            detail::fixed(100.0 * row.share_nearer.mean, 0) + " | " +
            detail::fixed(100.0 * row.share_aligned.mean, 0) + " | " +
            detail::fixed(row.median_ms, 1) + " |\n";
  }
  return text;
}

}  // namespace sketchloc

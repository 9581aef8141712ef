#include "eval/filter_trials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

/// The numbers of a step in a trial's JSON, by name.
constexpr std::array<std::pair<const char*, double StepError::*>, 11> kFigures = {
    {{"time_s", &StepError::time_s},
     {"driven_m", &StepError::driven_m},
     {"translation_px", &StepError::translation_px},
     {"translation_m", &StepError::translation_m},
     {"heading_rad", &StepError::heading_rad},
     {"scale_ratio", &StepError::scale_ratio},
     {"uncertainty_m", &StepError::uncertainty_m},
     {"stated_sigma_m", &StepError::stated_sigma_m},
     {"localized_probability", &StepError::localized_probability},
     {"share_within_bounds", &StepError::share_within_bounds},
     {"contradiction", &StepError::contradiction}}};

constexpr std::array<std::pair<const char*, FilterStart>, 3> kStarts = {
    {{"reference", FilterStart::Reference},
     {"anywhere", FilterStart::Anywhere},
     {"wrong drawing", FilterStart::WrongDrawing}}};

Json json_of(const std::optional<LocalizedSigns>& signs) {
  if (!signs) {
    return nullptr;
  }
  return {signs->way_m, signs->new_share, signs->evidence,
          signs->inlier_probability ? Json(*signs->inlier_probability) : Json(),
          signs->place_log_odds};
}

std::optional<LocalizedSigns> signs_of(const Json& json) {
  if (json.is_null()) {
    return std::nullopt;
  }
  const Json& inlier = json.at(3);
  return LocalizedSigns{
      .way_m = json.at(0).get<double>(),
      .new_share = json.at(1).get<double>(),
      .evidence = json.at(2).get<double>(),
      .inlier_probability = inlier.is_null() ? std::nullopt : std::optional(inlier.get<double>()),
      .place_log_odds = json.at(4).get<double>()};
}

/// Errors in a drawing in which no pose is right.
std::vector<StepError> errors_nowhere(std::span<const StepReport> steps) {
  std::vector<StepError> errors;
  for (const StepReport& step : steps) {
    errors.push_back({.step = step.step,
                      .time_s = step.time_s,
                      .translation_px = kNowhereM,
                      .translation_m = kNowhereM,
                      .heading_rad = std::numbers::pi,
                      .stated_sigma_m = stated_position_sigma_m(step.estimate),
                      .position_nees = std::nullopt,
                      .localized_probability = step.localized_probability,
                      .share_within_bounds = step.share_within_bounds,
                      .contradiction = step.contradiction,
                      .signs = step.signs});
  }
  return errors;
}

Json json_of(const std::vector<StepError>& errors) {
  Json json{{"step", Json::array()}};
  for (const auto& [name, figure] : kFigures) {
    json[name] = Json::array();
  }
  json["position_nees"] = Json::array();
  json["signs"] = Json::array();
  for (const StepError& error : errors) {
    json["step"].push_back(error.step);
    for (const auto& [name, figure] : kFigures) {
      json[name].push_back(error.*figure);
    }
    json["position_nees"].push_back(error.position_nees ? Json(*error.position_nees) : Json());
    json["signs"].push_back(json_of(error.signs));
  }
  return json;
}

std::vector<StepError> errors_of(const Json& json) {
  std::vector<StepError> errors(json.at("step").size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    errors[i].step = json.at("step").at(i).get<std::size_t>();
    for (const auto& [name, figure] : kFigures) {
      errors[i].*figure = json.at(name).at(i).get<double>();
    }
    const Json& nees = json.at("position_nees").at(i);
    errors[i].signs = signs_of(json.at("signs").at(i));
    errors[i].position_nees = nees.is_null() ? std::nullopt : std::optional(nees.get<double>());
  }
  return errors;
}

}  // namespace

void check_start(const std::string& set, const FilterData& data) {
  const auto& poses = data.reference.poses;
  if (poses.empty() || poses.front().step != 0) {
    throw std::runtime_error(set + ": the reference has no pose for the first scan");
  }
}

FilterTrial run_filter_trial(const FilterTask& task, const FilterData& data,
                             const LocalizationMethod& method, const LocalizationParams& params,
                             std::uint64_t seed, WarpPredictor* predictor) {
  if (data.start != FilterStart::Anywhere) {
    check_start(task.set, data);
  }
  LocalizationParams used = params;
  used.localizer = params_of(method, params.localizer);
  used.localizer.seed = seed;
  const Localization found =
      localize(data.sketch, data.run,
               {.method = method.method,
                .start_sketch_from_robot =
                    data.start == FilterStart::Anywhere
                        ? std::nullopt
                        : std::optional(data.reference.poses.front().sketch_from_robot),
                .predictor = predictor,
                .smoothing = method.smoothing},
               used);
  if (found.status != Localization::Status::Done) {
    throw std::runtime_error(task.set + ": cannot be localized in; it has no scans");
  }
  return {.set = task.set,
          .kind = task.kind,
          .method = method.name,
          .seed = seed,
          .errors = data.start == FilterStart::WrongDrawing
                        ? errors_nowhere(found.steps)
                        : step_errors(found.steps, data.reference, data.alternatives),
          .start = data.start,
          .carried_at = data.carried_at};
}

std::string trial_json(const FilterTrial& trial) {
  return Json{{"set", trial.set},
              {"kind", trial.kind},
              {"method", trial.method},
              {"seed", trial.seed},
              {"start",
               std::ranges::find(kStarts, trial.start, &decltype(kStarts)::value_type::second)
                   ->first},
              {"carried_at", trial.carried_at ? Json(*trial.carried_at) : Json()},
              {"errors", json_of(trial.errors)}}
             .dump() +
         "\n";
}

FilterTrial trial_from_json(const std::string& text) try {
  const Json json = Json::parse(text);
  const auto start = json.at("start").get<std::string>();
  const auto found =
      std::ranges::find(kStarts, start, [](const auto& one) { return std::string(one.first); });
  if (found == kStarts.end()) {
    throw std::runtime_error("not a trial: there is no start " + start);
  }
  const Json& carried = json.at("carried_at");
  return {
      .set = json.at("set").get<std::string>(),
      .kind = json.at("kind").get<std::string>(),
      .method = json.at("method").get<std::string>(),
      .seed = json.at("seed").get<std::uint64_t>(),
      .errors = errors_of(json.at("errors")),
      .start = found->second,
      .carried_at = carried.is_null() ? std::nullopt : std::optional(carried.get<std::size_t>())};
} catch (const Json::exception& error) {
  throw std::runtime_error(std::string("not a trial: ") + error.what());
}

}  // namespace sketchloc

#include "eval/filter_trials.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

/// The numbers of a step in a trial's JSON, by name.
constexpr std::array<std::pair<const char*, double StepError::*>, 8> kFigures = {
    {{"time_s", &StepError::time_s},
     {"driven_m", &StepError::driven_m},
     {"translation_px", &StepError::translation_px},
     {"translation_m", &StepError::translation_m},
     {"heading_rad", &StepError::heading_rad},
     {"scale_ratio", &StepError::scale_ratio},
     {"uncertainty_m", &StepError::uncertainty_m},
     {"stated_sigma_m", &StepError::stated_sigma_m}}};

Json json_of(const std::vector<StepError>& errors) {
  Json json{{"step", Json::array()}};
  for (const auto& [name, figure] : kFigures) {
    json[name] = Json::array();
  }
  json["position_nees"] = Json::array();
  for (const StepError& error : errors) {
    json["step"].push_back(error.step);
    for (const auto& [name, figure] : kFigures) {
      json[name].push_back(error.*figure);
    }
    json["position_nees"].push_back(error.position_nees ? Json(*error.position_nees) : Json());
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
    errors[i].position_nees = nees.is_null() ? std::nullopt : std::optional(nees.get<double>());
  }
  return errors;
}

}  // namespace

std::vector<FilterMethod> filter_methods() {
  using enum RegistrationMethod;
  return {{.name = "odometry", .method = Method::Odometry, .registration = {}},
          {.name = "icp", .method = Method::Chained, .registration = Icp},
          {.name = "affine", .method = Method::Chained, .registration = Affine},
          {.name = "chen20", .method = Method::Chained, .registration = Chen20},
          {.name = "ours", .method = Method::Chained, .registration = Ours},
          {.name = "mcl", .registration = {}},
          {.name = "mcl+measure", .registration = Ours, .measure = true},
          {.name = "mcl+propose", .registration = Ours, .propose = true},
          {.name = "mcl+both", .registration = Ours, .propose = true, .measure = true}};
}

void check_start(const std::string& set, const FilterData& data) {
  const auto& poses = data.reference.poses;
  if (poses.empty() || poses.front().step != 0) {
    throw std::runtime_error(set + ": the reference has no pose for the first scan");
  }
}

FilterTrial run_filter_trial(const FilterTask& task, const FilterData& data,
                             const FilterMethod& method, const LocalizationParams& params,
                             std::uint64_t seed, WarpPredictor* predictor) {
  check_start(task.set, data);
  LocalizationParams used = params;
  used.localizer.seed = seed;
  used.localizer.fusion.propose = method.propose;
  used.localizer.fusion.measure = method.measure;
  const Localization found =
      localize(data.sketch, data.run,
               {.method = method.method,
                .start_sketch_from_robot = data.reference.poses.front().sketch_from_robot,
                .predictor = predictor},
               used);
  if (found.status != Localization::Status::Done) {
    throw std::runtime_error(task.set + ": cannot be localized in; it has no scans");
  }
  return {.set = task.set,
          .kind = task.kind,
          .method = method.name,
          .seed = seed,
          .errors = step_errors(found.steps, data.reference, data.alternatives)};
}

std::string trial_json(const FilterTrial& trial) {
  return Json{{"set", trial.set},
              {"kind", trial.kind},
              {"method", trial.method},
              {"seed", trial.seed},
              {"errors", json_of(trial.errors)}}
             .dump() +
         "\n";
}

FilterTrial trial_from_json(const std::string& text) try {
  const Json json = Json::parse(text);
  return {.set = json.at("set").get<std::string>(),
          .kind = json.at("kind").get<std::string>(),
          .method = json.at("method").get<std::string>(),
          .seed = json.at("seed").get<std::uint64_t>(),
          .errors = errors_of(json.at("errors"))};
} catch (const Json::exception& error) {
  throw std::runtime_error(std::string("not a trial: ") + error.what());
}

}  // namespace sketchloc

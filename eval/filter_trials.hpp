#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sketch.hpp"
#include "eval/localization_methods.hpp"
#include "eval/sketch_errors.hpp"

namespace sketchloc {

/// What a run starts with.
enum class FilterStart {
  Reference,    ///< the reference's first pose
  Anywhere,     ///< nothing
  WrongDrawing  ///< the reference's first pose in a drawing of another building: never right
};

/// A robot in a drawing, with the truth.
struct FilterData {
  Sketch sketch;
  Run run;
  Reference reference;
  std::vector<Reference> alternatives = {};  ///< other readings of the drawing that count too
  FilterStart start = FilterStart::Reference;
  std::optional<std::size_t> carried_at = std::nullopt;  ///< step before which it was carried away
};

/// A run to be found, made when it is needed.
struct FilterTask {
  std::string set;
  std::string kind;  ///< of sets that make one row
  std::function<FilterData()> make;
  FilterStart start = FilterStart::Reference;  ///< of the data
};

/// How far off one method with one seed was at the scored steps of one set.
struct FilterTrial {
  std::string set;
  std::string kind;
  std::string method;
  std::uint64_t seed = 1;
  std::vector<StepError> errors;
  FilterStart start = FilterStart::Reference;
  std::optional<std::size_t> carried_at = std::nullopt;  ///< step, see FilterData
};

/// Throws std::runtime_error where the reference has no pose for the first scan.
void check_start(const std::string& set, const FilterData& data);

/// The error in a drawing of another building, m and rad: nowhere is right.
inline constexpr double kNowhereM = 1e6;

/// Finds the robot of a set by a method, from the start that the set has. What the method goes
/// without is switched off. Throws std::runtime_error where the set has no start.
FilterTrial run_filter_trial(const FilterTask& task, const FilterData& data,
                             const LocalizationMethod& method, const LocalizationParams& params,
                             std::uint64_t seed, WarpPredictor* predictor);

/// A trial as JSON, and back. Throws std::runtime_error where the text is not of a trial.
std::string trial_json(const FilterTrial& trial);
FilterTrial trial_from_json(const std::string& text);

}  // namespace sketchloc

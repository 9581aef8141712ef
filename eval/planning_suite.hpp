#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "planning/planner.hpp"

namespace sketchloc {

/// Questions to the planner in simulated drawings by simulated people.
struct PlanningSuiteParams {
  int drawings = 10;           ///< by turns of homes, offices and warehouses, >= 1
  int queries = 10;            ///< in each, >= 1
  double least_way_m = 5.0;    ///< between start and goal, as the crow flies, >= 0
  double deadline_ms = 100.0;  ///< of one question, > 0
};

template <typename Visitor>
void visit_fields(PlanningSuiteParams& params, Visitor&& visit) {
  visit("drawings", params.drawings);
  visit("queries", params.queries);
  visit("least_way_m", params.least_way_m);
  visit("deadline_ms", params.deadline_ms);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const PlanningSuiteParams& params);

/// One answer to one question.
struct PlanningTrial {
  int drawing = 0;
  int query = 0;
  std::string method;  ///< an objective, or kPlanningBaseline
  bool found = false;
  PathFigures figures = {};
  double first_ms = 0.0;        ///< until the first way was there, wall clock
  double first_length_m = 0.0;  ///< of that way
  double ms = 0.0;              ///< until the end, wall clock
};

/// Search on the grid for the shortest way, then shortcuts between all of its px.
inline constexpr const char* kPlanningBaseline = "grid + shortcuts";

/// All answers about one drawing: the baseline's, and the planner's with each objective. `clock`
/// gives seconds. Times are of questions alone: what is computed once for a drawing is not in them.
std::vector<PlanningTrial> ask_about_drawing(int drawing, const PlanningSuiteParams& suite,
                                             const PlanParams& params, std::uint64_t seed,
                                             const std::function<double()>& clock);

/// `metrics.json`, `trials.csv`, a table for a document, and a page.
std::string planning_suite_json(std::span<const PlanningTrial> trials, std::uint64_t seed);
std::string planning_trials_csv(std::span<const PlanningTrial> trials);
std::string planning_suite_markdown(std::span<const PlanningTrial> trials, std::uint64_t seed);
std::string planning_suite_html(std::span<const PlanningTrial> trials, std::uint64_t seed);

}  // namespace sketchloc

#include "planning/planner.hpp"

#include <algorithm>
#include <utility>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "planning/path_improver.hpp"
#include "planning/random_tree.hpp"
#include "planning/turning_search.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kImproverStream = 1ULL << 32;  // far from those of the trees
constexpr int kTellEvery = 500;
constexpr int kMostShortcuts = 300;  ///< of curves, which are long to try

Plan plan_of(PathPoints path_in_sketch, Plan::Source source, const FreeSpace& space) {
  Plan plan;
  plan.status = Plan::Status::Found;
  plan.source = source;
  plan.figures = figures_of(path_in_sketch, space);
  plan.path_in_sketch = std::move(path_in_sketch);
  return plan;
}

void tell(const PlanWatch& watch, const Plan& plan) {
  if (watch.found) {
    watch.found(plan);
  }
}

bool is_over(const PlanWatch& watch) { return watch.out_of_time && watch.out_of_time(); }

}  // namespace

void validate(const PlanParams& params) {
  validate_part("body", params.body);
  require_at_least("move_ends_m", params.move_ends_m, 0.0);
  if (params.crossing_cost_m) {
    require_above("crossing_cost_m", *params.crossing_cost_m, 0.0);
  }
  require_at_least("turning_radius_m", params.turning_radius_m, 0.0);
  require_at_least("tree_nodes", params.tree_nodes, 0.0);
  require_at_least("improvements", params.improvements, 0.0);
}

std::string_view name_of(Plan::Status status) {
  switch (status) {
    case Plan::Status::Found:
      return "found";
    case Plan::Status::FoundAcross:
      return "found across strokes";
    case Plan::Status::StartOutside:
      return "start outside";
    case Plan::Status::StartBlocked:
      return "start blocked";
    case Plan::Status::GoalOutside:
      return "goal outside";
    case Plan::Status::GoalBlocked:
      return "goal blocked";
    case Plan::Status::NoPath:
      return "no path";
    case Plan::Status::TooTight:
      return "too tight to turn";
    case Plan::Status::OutOfTime:
      return "out of time";
  }
  return "";
}

std::string_view name_of(Plan::Source source) {
  switch (source) {
    case Plan::Source::LastPath:
      return "last path";
    case Plan::Source::Line:
      return "line";
    case Plan::Source::Trees:
      return "trees";
    case Plan::Source::Grid:
      return "grid";
    case Plan::Source::Improvement:
      return "improvement";
    case Plan::Source::Turning:
      return "turning";
  }
  return "";
}

Planner::Planner(const Sketch& sketch, const ScaleField& scale, const PlanParams& params)
    : Planner((validate(params), distance_field_px(sketch.occupied)), scale, params) {}

Planner::Planner(Grid<float> stroke_distance_px, const ScaleField& scale, const PlanParams& params)
    : params_((validate(params), params)),
      space_(std::move(stroke_distance_px), scale, params.body, params.objective) {}

Plan Planner::plan(const PlanQuery& query, std::uint64_t seed, const PlanWatch& watch) const {
  if (std::optional<Plan> blocked = blocked_end(query)) {
    return *std::move(blocked);
  }
  PlanQuery moved = query;
  moved.start_in_sketch = *moved_end(query.start_in_sketch);
  moved.goal_in_sketch = *moved_end(query.goal_in_sketch);
  Plan plan = plan_in(space_, moved, seed, watch);
  if (plan.status == Plan::Status::NoPath && params_.crossing_cost_m) {
    plan = plan_in(space_.with_crossings(*params_.crossing_cost_m), moved, seed, watch);
    plan.status = plan.found() ? Plan::Status::FoundAcross : plan.status;
  }
  return plan;
}

/// The end itself where it is free, else a free place as near as allowed.
std::optional<Eigen::Vector2d> Planner::moved_end(const Eigen::Vector2d& end_in_sketch) const {
  const std::optional<Eigen::Vector2d> nearest = space_.nearest_free(end_in_sketch);
  const bool near = nearest && space_.contains(end_in_sketch) &&
                    space_.length_m(end_in_sketch, *nearest) <= params_.move_ends_m;
  return near ? nearest : std::nullopt;
}

std::optional<Plan> Planner::blocked_end(const PlanQuery& query) const {
  const auto blocked = [&](const Eigen::Vector2d& end, Plan::Status outside, Plan::Status status) {
    Plan plan;
    plan.status = space_.contains(end) ? status : outside;
    plan.nearest_free_in_sketch = space_.nearest_free(end);
    return plan;
  };
  if (!moved_end(query.start_in_sketch)) {
    return blocked(query.start_in_sketch, Plan::Status::StartOutside, Plan::Status::StartBlocked);
  }
  if (!moved_end(query.goal_in_sketch)) {
    return blocked(query.goal_in_sketch, Plan::Status::GoalOutside, Plan::Status::GoalBlocked);
  }
  return std::nullopt;
}

/// A way as quickly as one can be had; none says nothing.
std::optional<Plan> Planner::first_path(const FreeSpace& space, const PlanQuery& query,
                                        std::uint64_t seed) const {
  PathPoints rest = rest_of(query.last_path_in_sketch, query.start_in_sketch);
  if (!rest.empty()) {
    rest.push_back(query.goal_in_sketch);
    if (is_free(rest, space)) {
      return plan_of(pulled_straight(rest, space), Plan::Source::LastPath, space);
    }
  }
  if (space.is_free(query.start_in_sketch, query.goal_in_sketch)) {
    return plan_of({query.start_in_sketch, query.goal_in_sketch}, Plan::Source::Line, space);
  }
  if (params_.tree_nodes == 0) {
    return std::nullopt;
  }
  const std::optional<PathPoints> connected =
      connect_trees(space, query.start_in_sketch, query.goal_in_sketch, params_.tree_nodes, seed);
  return connected ? std::optional(
                         plan_of(pulled_straight(*connected, space), Plan::Source::Trees, space))
                   : std::nullopt;
}

/// The cheapest way on the grid, pulled straight.
Planner::OnGrid Planner::search(const FreeSpace& space, const PlanQuery& query, GridPrice price,
                                const PlanWatch& watch) {
  const GridSearch searched = search_grid(space, query.start_in_sketch, query.goal_in_sketch, price,
                                          [&] { return is_over(watch); });
  OnGrid found{.status = searched.status, .plan = std::nullopt};
  if (searched.status == GridSearch::Status::Found) {
    found.plan = plan_of(pulled_straight(corners_of(searched.path_in_sketch), space),
                         Plan::Source::Grid, space);
  }
  return found;
}

Plan Planner::plan_in(const FreeSpace& space, const PlanQuery& query, std::uint64_t seed,
                      const PlanWatch& watch) const {
  if (params_.turning_radius_m > 0.0) {
    return plan_turning(space, query, seed, watch);
  }
  std::optional<Plan> best = first_path(space, query, seed);
  if (!best) {  // by length: soon found, and certain where there is no way at all
    OnGrid found = search(space, query, GridPrice::Length, watch);
    if (!found.plan) {
      Plan nothing;
      nothing.status = found.status == GridSearch::Status::OutOfTime ? Plan::Status::OutOfTime
                                                                     : Plan::Status::NoPath;
      return nothing;
    }
    best = std::move(found.plan);
  }
  tell(watch, *best);
  const OnGrid found = search(space, query, GridPrice::Objective, watch);
  if (found.plan && found.plan->figures.cost_m < best->figures.cost_m) {
    best = found.plan;
    tell(watch, *best);
  }
  improve(*best, space, seed, watch);
  return *std::move(best);
}

/// A way of arcs, then a shorter one.
Plan Planner::plan_turning(const FreeSpace& space, const PlanQuery& query, std::uint64_t seed,
                           const PlanWatch& watch) const {
  using Status = TurningSearch::Status;
  const double radius_px = params_.turning_radius_m / space.least_m_per_px();
  const TurningSearch searched = search_turning(space,
                                                {.start_in_sketch = query.start_in_sketch,
                                                 .goal_in_sketch = query.goal_in_sketch,
                                                 .start_heading_rad = query.start_heading_rad,
                                                 .goal_heading_rad = query.goal_heading_rad,
                                                 .radius_px = radius_px},
                                                [&] { return is_over(watch); });
  if (searched.status != Status::Found) {
    const bool may_pass = search(space, query, GridPrice::Length, {}).plan.has_value();
    Plan nothing;
    nothing.status = searched.status == Status::OutOfTime ? Plan::Status::OutOfTime
                     : may_pass                           ? Plan::Status::TooTight
                                                          : Plan::Status::NoPath;
    return nothing;
  }
  tell(watch, plan_of(places_of(searched.curve), Plan::Source::Turning, space));
  const TurningCurve shorter = shortened(searched.curve, space,
                                         {.radius_px = radius_px,
                                          .tries = std::min(params_.improvements, kMostShortcuts),
                                          .seed = seed},
                                         [&] { return is_over(watch); });
  Plan plan = plan_of(places_of(shorter), Plan::Source::Improvement, space);
  tell(watch, plan);
  check(is_free(plan.path_in_sketch, space), "a way that is given away is free");
  return plan;
}

void Planner::improve(Plan& plan, const FreeSpace& space, std::uint64_t seed,
                      const PlanWatch& watch) const {
  if (plan.path_in_sketch.size() < 2) {
    return;
  }
  PathImprover improver(space, plan.path_in_sketch, make_rng(seed, kImproverStream));
  const double least_gain_m = 1e-3 * plan.figures.cost_m;
  for (int i = 0; i < params_.improvements && !is_over(watch); ++i) {
    improver.improve();
    const bool tells = (i + 1) % kTellEvery == 0 || i + 1 == params_.improvements;
    if (tells && improver.cost_m() < plan.figures.cost_m - least_gain_m) {
      plan = plan_of(improver.path_in_sketch(), Plan::Source::Improvement, space);
      tell(watch, plan);
    }
  }
  if (improver.cost_m() < plan.figures.cost_m) {
    plan = plan_of(improver.path_in_sketch(), Plan::Source::Improvement, space);
  }
  check(is_free(plan.path_in_sketch, space), "a way that is given away is free");
}

}  // namespace sketchloc

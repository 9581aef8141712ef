#include "eval/planning_suite.hpp"

#include <stdexcept>

#include "datasets/sim/person.hpp"
#include "datasets/sim/plan_generators.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSuite = 7000;  // buildings of no other suite
constexpr int kAttempts = 1000;

struct PlanningDrawing {
  FloorPlan plan;
  Drawing drawing;
  double px_per_m = 1.0;
};

PlanningDrawing drawing_of(int drawing, std::uint64_t seed) {
  constexpr BuildingKind kKinds[] = {BuildingKind::Home, BuildingKind::Office,
                                     BuildingKind::Warehouse};
  for (std::uint64_t attempt = 0; attempt < 20; ++attempt) {
    Rng rng = make_rng(seed, kSuite + static_cast<std::uint64_t>(drawing), attempt);
    const FloorPlan plan = make_plan(kKinds[drawing % 3], rng);
    Drawing made = draw(plan, human_person(), rng);
    if (made.status == Drawing::Status::Drawn) {
      const Eigen::Vector2d middle = bounds_in_world(plan).centre();
      const double px_per_m = local_similarity(made.sketch_from_world.at(middle).jacobian).scale;
      return {plan, std::move(made), px_per_m};
    }
  }
  throw std::runtime_error("nobody draws anything");
}

/// A free place in the drawing of a room.
Eigen::Vector2d place_in_rooms(const PlanningDrawing& drawn, const FreeSpace& space, Rng& rng) {
  Eigen::Vector2d place(-1.0, -1.0);  // outside: not free
  for (int attempt = 0; attempt < kAttempts && !space.is_free(place); ++attempt) {
    const auto rooms = static_cast<double>(drawn.plan.rooms.size());
    const PlaneBox& box =
        drawn.plan.rooms[static_cast<std::size_t>(uniform(0.0, rooms, rng))].box_in_world;
    const double x_m = uniform(box.low.x(), box.high.x(), rng);
    const double y_m = uniform(box.low.y(), box.high.y(), rng);
    place = drawn.drawing.sketch_from_world({x_m, y_m});
  }
  return place;
}

/// Two places that are far enough apart; whether there is a way is not asked.
PlanQuery query_of(const PlanningDrawing& drawn, const FreeSpace& space, double least_way_m,
                   Rng& rng) {
  PlanQuery query;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    query.start_in_sketch = place_in_rooms(drawn, space, rng);
    query.goal_in_sketch = place_in_rooms(drawn, space, rng);
    const double apart_px = (query.start_in_sketch - query.goal_in_sketch).norm();
    if (apart_px >= least_way_m * drawn.px_per_m) {
      break;
    }
  }
  return query;
}

struct Stopwatch {
  const std::function<double()>& clock;
  double begin_s = clock();

  double ms() const { return 1e3 * (clock() - begin_s); }
};

PlanningTrial ask_baseline(const FreeSpace& space, const PlanQuery& query,
                           const std::function<double()>& clock) {
  PlanningTrial trial{.method = kPlanningBaseline};
  const Stopwatch watch{clock};
  const GridSearch searched = search_grid(space, query.start_in_sketch, query.goal_in_sketch);
  trial.found = searched.status == GridSearch::Status::Found;
  const PathPoints path = pulled_straight(searched.path_in_sketch, space);
  trial.ms = watch.ms();
  trial.first_ms = trial.ms;
  trial.figures = figures_of(path, space);
  trial.first_length_m = trial.figures.length_m;
  return trial;
}

PlanningTrial ask_planner(const Planner& planner, const PlanQuery& query, double deadline_ms,
                          std::uint64_t seed, const std::function<double()>& clock) {
  PlanningTrial trial;
  const Stopwatch watch{clock};
  bool first = true;
  const Plan plan = planner.plan(query, seed,
                                 {.out_of_time = [&] { return watch.ms() > deadline_ms; },
                                  .found =
                                      [&](const Plan& better) {
                                        trial.first_ms = first ? watch.ms() : trial.first_ms;
                                        trial.first_length_m =
                                            first ? better.figures.length_m : trial.first_length_m;
                                        first = false;
                                      }});
  trial.ms = watch.ms();
  trial.found = plan.found();
  trial.figures = plan.figures;
  return trial;
}

}  // namespace

void validate(const PlanningSuiteParams& params) {
  require_at_least("drawings", params.drawings, 1.0);
  require_at_least("queries", params.queries, 1.0);
  require_at_least("least_way_m", params.least_way_m, 0.0);
  require_above("deadline_ms", params.deadline_ms, 0.0);
}

std::vector<PlanningTrial> ask_about_drawing(int drawing, const PlanningSuiteParams& suite,
                                             const PlanParams& params, std::uint64_t seed,
                                             const std::function<double()>& clock) {
  const PlanningDrawing drawn = drawing_of(drawing, seed);
  PlanParams of_objective = params;
  of_objective.improvements = std::numeric_limits<int>::max();  // the deadline ends the work
  std::vector<std::pair<std::string, Planner>> planners;
  for (const auto& [name, objective] : names_of(Objective{})) {
    of_objective.objective = objective;
    planners.emplace_back(name,
                          Planner(drawn.drawing.sketch, ScaleField(drawn.px_per_m), of_objective));
  }
  const FreeSpace shortest(drawn.drawing.sketch, ScaleField(drawn.px_per_m), params.body,
                           Objective::Shortest);
  std::vector<PlanningTrial> trials;
  const auto add = [&](PlanningTrial trial, int query) {
    trial.drawing = drawing;
    trial.query = query;
    trials.push_back(std::move(trial));
  };
  for (int i = 0; i < suite.queries; ++i) {
    Rng rng = make_rng(seed, kSuite + static_cast<std::uint64_t>(drawing),
                       1000 + static_cast<std::uint64_t>(i));
    const PlanQuery query = query_of(drawn, shortest, suite.least_way_m, rng);
    add(ask_baseline(shortest, query, clock), i);
    for (const auto& [name, planner] : planners) {
      PlanningTrial trial = ask_planner(planner, query, suite.deadline_ms, rng(), clock);
      trial.method = name;
      add(std::move(trial), i);
    }
  }
  return trials;
}

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "planning/grid_search.hpp"
#include "planning/path.hpp"

namespace sketchloc {

struct PlanParams {
  Objective objective = Objective::Balanced;
  BodyParams body{};
  double move_ends_m = 0.0;  ///< a start or goal that is not free may be moved this far, >= 0
  /// Strokes may be crossed where there is no other way, at the cost of so many metres: doors are
  /// drawn shut. None: never. Walls that were forgotten cannot be known.
  std::optional<double> crossing_cost_m = std::nullopt;
  /// Least one that the robot drives forwards, >= 0; 0: it turns on the spot. In px it is that of
  /// the place where a metre is largest in the drawing, and so nowhere less in real metres.
  double turning_radius_m = 0.0;
  int tree_nodes = 1000;     ///< tries of the random trees before the grid is searched, >= 0
  int improvements = 20000;  ///< tries to improve the way at most, >= 0
};

template <typename Visitor>
void visit_fields(PlanParams& params, Visitor&& visit) {
  visit("objective", params.objective);
  visit("body", params.body);
  visit("move_ends_m", params.move_ends_m);
  visit("crossing_cost_m", params.crossing_cost_m);
  visit("turning_radius_m", params.turning_radius_m);
  visit("tree_nodes", params.tree_nodes);
  visit("improvements", params.improvements);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const PlanParams& params);

struct PlanQuery {
  Eigen::Vector2d start_in_sketch = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_in_sketch = Eigen::Vector2d::Zero();
  PathPoints last_path_in_sketch = {};  ///< an earlier way to the same goal; empty: none
  /// Where a robot looks that cannot turn on the spot, in the sketch frame; none: anywhere.
  std::optional<double> start_heading_rad = std::nullopt;
  std::optional<double> goal_heading_rad = std::nullopt;
};

struct Plan {
  enum class Status {
    Found,
    FoundAcross,  ///< by crossing strokes: there is no other way
    StartOutside,
    StartBlocked,
    GoalOutside,
    GoalBlocked,
    NoPath,    ///< certain, as far as px tell
    TooTight,  ///< nothing was found with the turning radius, though there is room to pass
    OutOfTime  ///< nothing was found before
  };
  /// What brought the way.
  enum class Source { LastPath, Line, Trees, Grid, Improvement, Turning };

  Status status = Status::NoPath;
  PathPoints path_in_sketch = {};  ///< where found, from the start or the free place near it
  PathFigures figures = {};
  Source source = Source::Trees;
  std::optional<Eigen::Vector2d> nearest_free_in_sketch = std::nullopt;  ///< of a blocked end

  bool found() const { return status == Status::Found || status == Status::FoundAcross; }
};
std::string_view name_of(Plan::Status status);
std::string_view name_of(Plan::Source source);

/// Who looks on while a way is found and made better.
struct PlanWatch {
  TimeIsOver out_of_time = {};                  ///< none: only `improvements` limits the work
  std::function<void(const Plan&)> found = {};  ///< hears every better way
};

/// Ways in one drawing for one robot. Anytime: the rest of the last way, a straight line or two
/// random trees give a first way in a fraction of the time of the search on the grid, which then
/// says what is best up to small changes, or that there is none; random changes make it better
/// until the time is over. The same seed gives the same way where no time is asked for.
class Planner {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  Planner(const Sketch& sketch, const ScaleField& scale, const PlanParams& params);
  /// The same of distance_field_px() of the strokes.
  Planner(Grid<float> stroke_distance_px, const ScaleField& scale, const PlanParams& params);

  Plan plan(const PlanQuery& query, std::uint64_t seed, const PlanWatch& watch = {}) const;

  const FreeSpace& space() const { return space_; }

 private:
  Plan plan_in(const FreeSpace& space, const PlanQuery& query, std::uint64_t seed,
               const PlanWatch& watch) const;
  struct OnGrid {
    GridSearch::Status status;
    std::optional<Plan> plan;
  };
  static OnGrid search(const FreeSpace& space, const PlanQuery& query, GridPrice price,
                       const PlanWatch& watch);
  std::optional<Plan> first_path(const FreeSpace& space, const PlanQuery& query,
                                 std::uint64_t seed) const;
  std::optional<Plan> blocked_end(const PlanQuery& query) const;
  std::optional<Eigen::Vector2d> moved_end(const Eigen::Vector2d& end_in_sketch) const;
  Plan plan_turning(const FreeSpace& space, const PlanQuery& query, std::uint64_t seed,
                    const PlanWatch& watch) const;
  void improve(Plan& plan, const FreeSpace& space, std::uint64_t seed,
               const PlanWatch& watch) const;

  PlanParams params_;
  FreeSpace space_;
};

}  // namespace sketchloc

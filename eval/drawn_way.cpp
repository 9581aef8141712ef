#include "eval/drawn_way.hpp"

#include <algorithm>

#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

constexpr double kDense_m = 0.25;         ///< between the points of the rest of a way
constexpr double kSampleSpacing_m = 0.5;  ///< scales nearer to each other tell the same

}  // namespace

DrawnWay::DrawnWay(const Sketch& sketch, const Eigen::Vector2d& goal_in_sketch,
                   const PlanParams& params)
    : stroke_distance_px_(distance_field_px(sketch.occupied)),
      goal_in_sketch_(goal_in_sketch),
      params_(params) {}

void DrawnWay::add(const Sim2& sketch_from_robot) {
  sketch_from_robot_ = sketch_from_robot;
  const auto apart_m = [&] {
    return (sketch_from_robot.translation() - samples_.back().place_in_sketch).norm() /
           sketch_from_robot.scale();
  };
  if (samples_.empty() || apart_m() >= kSampleSpacing_m) {
    samples_.push_back({sketch_from_robot.translation(), sketch_from_robot.scale()});
  }
}

void DrawnWay::plan(std::uint64_t seed) {
  const ScaleField scale(stroke_distance_px_.width(), stroke_distance_px_.height(), samples_);
  const Planner planner(stroke_distance_px_, scale, params_);
  const Plan plan = planner.plan({.start_in_sketch = sketch_from_robot_.translation(),
                                  .goal_in_sketch = goal_in_sketch_,
                                  .last_path_in_sketch = path_},
                                 seed);
  path_ = plan.found() ? plan.path_in_sketch : PathPoints{};
  if (plan.found()) {
    path_.push_back(goal_in_sketch_);  // the planner may have moved it
  }
}

bool DrawnWay::is_on_way(double within_m) const {
  const PathPoints rest = rest_of(path_, sketch_from_robot_.translation());
  return !rest.empty() && (rest[1] - rest[0]).norm() <= within_m * sketch_from_robot_.scale();
}

PathPoints DrawnWay::rest_in_robot(const RobotFinder& finder) const {
  const double step_px = kDense_m * sketch_from_robot_.scale();
  PathPoints rest = {Eigen::Vector2d::Zero()};
  const PathPoints ahead = rest_of(path_, sketch_from_robot_.translation());
  for (std::size_t i = 2; i < ahead.size(); ++i) {
    const Eigen::Vector2d side = ahead[i] - ahead[i - 1];
    const int parts = std::max(1, static_cast<int>(side.norm() / step_px));
    for (int part = 1; part <= parts; ++part) {
      rest.push_back(
          finder.robot_from_sketch(ahead[i - 1] + side * (static_cast<double>(part) / parts)));
    }
  }
  return rest.size() > 1 ? rest : PathPoints{};
}

}  // namespace sketchloc

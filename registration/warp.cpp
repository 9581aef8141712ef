#include "registration/warp.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "registration/polar.hpp"

namespace sketchloc {
namespace {

constexpr double kToleranceM = 1e-7;
constexpr double kTolerancePx = 1e-6;

std::optional<ThinPlateSpline> spline_through(std::span<const Eigen::Vector2d> points,
                                              std::span<const Eigen::Vector2d> values) {
  const std::optional<TpsSolver> solver =
      TpsSolver::factor(std::vector<Eigen::Vector2d>(points.begin(), points.end()));
  return solver ? std::optional(solver->solve(values)) : std::nullopt;
}

}  // namespace

std::optional<Warp> Warp::from_robot_points(std::span<const Eigen::Vector2d> points_in_robot_m,
                                            std::span<const Eigen::Vector2d> places_in_sketch) {
  const auto spline = spline_through(points_in_robot_m, places_in_sketch);
  return spline ? std::optional(Warp(*spline, Direction::SketchFromRobot, kTolerancePx))
                : std::nullopt;
}

std::optional<Warp> Warp::from_sketch_places(std::span<const Eigen::Vector2d> places_in_sketch,
                                             std::span<const Eigen::Vector2d> points_in_robot_m) {
  const auto spline = spline_through(places_in_sketch, points_in_robot_m);
  return spline ? std::optional(Warp(*spline, Direction::RobotFromSketch, kToleranceM))
                : std::nullopt;
}

std::optional<Eigen::Vector2d> Warp::inverse(const Eigen::Vector2d& target) const {
  const Inversion found =
      invert(spline_, target, spline_.control_points().front(), {.tolerance = tolerance_});
  return found.status == Inversion::Status::Converged ? std::optional(found.point) : std::nullopt;
}

std::optional<PlaneMapPoint> Warp::sketch_from_robot(
    const Eigen::Vector2d& point_in_robot_m) const {
  if (direction_ == Direction::SketchFromRobot) {
    return spline_.at(point_in_robot_m);
  }
  const std::optional<Eigen::Vector2d> place = inverse(point_in_robot_m);
  if (!place) {
    return std::nullopt;
  }
  const Eigen::Matrix2d robot_from_sketch = spline_.jacobian(*place);
  if (robot_from_sketch.determinant() == 0.0) {
    return std::nullopt;
  }
  return PlaneMapPoint{.value = *place, .jacobian = robot_from_sketch.inverse()};
}

std::optional<Eigen::Vector2d> Warp::robot_from_sketch(
    const Eigen::Vector2d& place_in_sketch) const {
  return direction_ == Direction::RobotFromSketch ? std::optional(spline_(place_in_sketch))
                                                  : inverse(place_in_sketch);
}

std::optional<Sim2> Warp::pose() const {
  const std::optional<PlaneMapPoint> origin = sketch_from_robot(Eigen::Vector2d::Zero());
  if (!origin || !(origin->jacobian.determinant() > 0.0)) {
    return std::nullopt;
  }
  return Sim2::from_xy_yaw_scale(origin->value.x(), origin->value.y(),
                                 polar_yaw_rad(origin->jacobian),
                                 std::sqrt(origin->jacobian.determinant()));
}

FoldReport Warp::find_folds(const PlaneBox& box_in_robot_m, int samples_per_side) const {
  const PlaneMap map = [this](const Eigen::Vector2d& point) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return sketch_from_robot(point).value_or(PlaneMapPoint{
        .value = Eigen::Vector2d::Constant(kNone), .jacobian = Eigen::Matrix2d::Constant(kNone)});
  };
  return sketchloc::find_folds(map, box_in_robot_m, samples_per_side);
}

}  // namespace sketchloc

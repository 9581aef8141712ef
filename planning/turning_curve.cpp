#include "planning/turning_curve.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

namespace ob = ompl::base;

using Plane = ob::DubinsStateSpace;
using State = ob::ScopedState<Plane>;

constexpr double kSpacing_px = 1.0;

std::size_t parts_of(double way_px) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(way_px / kSpacing_px)));
}

}  // namespace

TurningCurve arc_from(const DrawnPose& from, double way_px, double curvature_per_px) {
  TurningCurve curve = {from};
  const std::size_t parts = parts_of(way_px);
  for (std::size_t part = 1; part <= parts; ++part) {
    const double way = way_px * static_cast<double>(part) / static_cast<double>(parts);
    const double turned_rad = way * curvature_per_px;
    const double chord =
        curvature_per_px == 0.0 ? way : 2.0 * std::sin(0.5 * turned_rad) / curvature_per_px;
    const double along_rad = from.heading_rad + 0.5 * turned_rad;
    curve.push_back(
        {from.place_in_sketch + chord * Eigen::Vector2d(std::cos(along_rad), std::sin(along_rad)),
         from.heading_rad + turned_rad});
  }
  return curve;
}

struct ShortestCurves::Curves {
  explicit Curves(double radius_px) : plane(std::make_shared<Plane>(radius_px)) {}

  State state_of(const DrawnPose& pose) const {
    State state(plane);
    state->setXY(pose.place_in_sketch.x(), pose.place_in_sketch.y());
    state->setYaw(std::remainder(pose.heading_rad, 2.0 * std::numbers::pi));
    return state;
  }

  std::shared_ptr<Plane> plane;
};

ShortestCurves::ShortestCurves(double radius_px)
    : curves_((check(radius_px > 0.0, "a turning radius is above 0"),
               std::make_unique<Curves>(radius_px))) {}

ShortestCurves::~ShortestCurves() = default;

double ShortestCurves::length_px(const DrawnPose& from, const DrawnPose& to) const {
  return curves_->plane->distance(curves_->state_of(from).get(), curves_->state_of(to).get());
}

TurningCurve ShortestCurves::between(const DrawnPose& from, const DrawnPose& to) const {
  const State begin = curves_->state_of(from);
  const State end = curves_->state_of(to);
  State at(curves_->plane);
  bool is_first = true;
  Plane::DubinsPath path;
  TurningCurve curve = {from};
  const std::size_t parts = parts_of(curves_->plane->distance(begin.get(), end.get()));
  for (std::size_t part = 1; part < parts; ++part) {
    const double share = static_cast<double>(part) / static_cast<double>(parts);
    curves_->plane->interpolate(begin.get(), end.get(), share, is_first, path, at.get());
    curve.push_back({{at->getX(), at->getY()}, at->getYaw()});
  }
  curve.push_back(to);
  return curve;
}

PathPoints places_of(const TurningCurve& curve) {
  PathPoints places;
  for (const DrawnPose& pose : curve) {
    places.push_back(pose.place_in_sketch);
  }
  return places;
}

double cost_m(const PathPoints& path_in_sketch, const FreeSpace& space) {
  double cost = 0.0;
  for (std::size_t i = 1; i < path_in_sketch.size(); ++i) {
    cost += space.cost_m(path_in_sketch[i - 1], path_in_sketch[i]);
  }
  return cost;
}

}  // namespace sketchloc

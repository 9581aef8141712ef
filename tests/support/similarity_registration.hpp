#pragma once

#include <vector>

#include "registration/warp_predictor.hpp"

namespace sketchloc::testing {

/// A registration that bends nothing: the robot's plane lies in the drawing as its pose says. It
/// states no covariance.
inline Registration similarity_registration(const Sim2& sketch_from_robot) {
  const std::vector<Eigen::Vector2d> points = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : points) {
    places.push_back(sketch_from_robot * point);
  }
  return {.warp = *Warp::from_robot_points(points, places),
          .sketch_from_robot = sketch_from_robot,
          .covariance = std::nullopt};
}

/// The same with alike and independent errors of so many metres, rad and shares of the scale.
inline Registration similarity_registration(const Sim2& sketch_from_robot, double sigma) {
  Registration registration = similarity_registration(sketch_from_robot);
  registration.covariance = sigma * sigma * Eigen::Matrix4d::Identity();
  return registration;
}

}  // namespace sketchloc::testing

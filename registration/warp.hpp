#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "motion/sim2.hpp"
#include "registration/plane_map.hpp"
#include "registration/tps.hpp"

namespace sketchloc {

/// How the robot's surroundings lie in a drawing: a thin plate spline between the robot's plane (m)
/// and the drawing (px), to be used in both directions whichever one it is made of.
class Warp {
 public:
  /// The spline that takes points of the robot's plane to places in the drawing. None where no
  /// spline is defined (TpsSolver).
  static std::optional<Warp> from_robot_points(std::span<const Eigen::Vector2d> points_in_robot_m,
                                               std::span<const Eigen::Vector2d> places_in_sketch);

  /// The spline that takes places in the drawing to points of the robot's plane: the convention of
  /// [Chen20], whose control points lie evenly in the drawing.
  static std::optional<Warp> from_sketch_places(std::span<const Eigen::Vector2d> places_in_sketch,
                                                std::span<const Eigen::Vector2d> points_in_robot_m);

  /// Place in the drawing, and Jacobian in px/m, of a point of the robot's plane. None where a warp
  /// that is made of the other direction has no such point.
  std::optional<PlaneMapPoint> sketch_from_robot(const Eigen::Vector2d& point_in_robot_m) const;

  /// Point of the robot's plane that lies at a place in the drawing. None as above.
  std::optional<Eigen::Vector2d> robot_from_sketch(const Eigen::Vector2d& place_in_sketch) const;

  /// The robot's pose: the image of its origin, the rotation of the Jacobian's polar decomposition,
  /// and sqrt(det). None where the warp folds there.
  std::optional<Sim2> pose() const;

  /// Least det J, in (px/m)^2, on a lattice over a box of the robot's plane. A warp folds too where
  /// it has no value.
  FoldReport find_folds(const PlaneBox& box_in_robot_m, int samples_per_side) const;

 private:
  enum class Direction { SketchFromRobot, RobotFromSketch };

  Warp(ThinPlateSpline spline, Direction direction, double tolerance)
      : spline_(std::move(spline)), direction_(direction), tolerance_(tolerance) {}

  std::optional<Eigen::Vector2d> inverse(const Eigen::Vector2d& target) const;

  ThinPlateSpline spline_;
  Direction direction_;
  double tolerance_;  ///< of the inverse, in the spline's output unit
};

}  // namespace sketchloc

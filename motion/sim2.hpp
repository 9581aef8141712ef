#pragma once

#include <Eigen/Core>
#include <complex>

#include "motion/se2.hpp"

namespace sketchloc {

/// Similarity of the plane: rotation, uniform scale > 0, translation. It joins metres to drawing
/// pixels, so `Sim2 sketch_from_robot` is the robot's pose in the drawing: position px, heading
/// rad, local scale px/m. Twists are ordered (x, y, yaw, log scale).
class Sim2 {
 public:
  Sim2() = default;  ///< identity

  /// Checks scale > 0.
  static Sim2 from_xy_yaw_scale(double x, double y, double yaw_rad, double scale);
  static Sim2 from_se2(const Se2& rigid, double scale = 1.0);
  /// Exponential map of the Lie algebra sim(2).
  static Sim2 exp(const Eigen::Vector4d& twist);

  /// Keeps every bit, for states that are read back. Checks scale > 0.
  static Sim2 from_parts(const Eigen::Vector2d& translation,
                         const std::complex<double>& scaled_rotation);

  double x() const { return translation_.x(); }
  double y() const { return translation_.y(); }
  double yaw_rad() const;  ///< in (-pi, pi]
  double scale() const { return std::abs(scaled_rotation_); }
  const Eigen::Vector2d& translation() const { return translation_; }
  const std::complex<double>& scaled_rotation() const { return scaled_rotation_; }
  Eigen::Matrix2d scaled_rotation_matrix() const;

  Sim2 inverse() const;
  Eigen::Vector4d log() const;      ///< inverse of exp; yaw in (-pi, pi]
  Eigen::Matrix4d adjoint() const;  ///< S exp(t) S^-1 = exp(adjoint * t)
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const;
  Sim2 operator*(const Sim2& other) const;
  Sim2 operator*(const Se2& other) const;

 private:
  Eigen::Vector2d translation_ = Eigen::Vector2d::Zero();
  std::complex<double> scaled_rotation_ = 1.0;
};

/// The similarity a share (0..1) of the way along the constant-twist path between two.
Sim2 interpolate(const Sim2& from, const Sim2& to, double share);

}  // namespace sketchloc

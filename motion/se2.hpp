#pragma once

#include <Eigen/Core>
#include <complex>

namespace sketchloc {

/// Rigid motion of the plane, joining two frames in metres. `a_from_b` takes coordinates in b to
/// coordinates in a. Twists are ordered (x, y, yaw). Rotation is a unit complex number.
class Se2 {
 public:
  Se2() = default;  ///< identity

  static Se2 from_xy_yaw(double x_m, double y_m, double yaw_rad);
  /// Exponential map of (v_x, v_y, yaw): the pose after one unit of time at that body velocity.
  static Se2 exp(const Eigen::Vector3d& twist);

  /// Keeps every bit, for states that are read back. Checks that the rotation has unit length.
  static Se2 from_parts(const Eigen::Vector2d& translation_m, const std::complex<double>& rotation);

  double x_m() const { return translation_.x(); }
  double y_m() const { return translation_.y(); }
  double yaw_rad() const;  ///< in (-pi, pi]
  const Eigen::Vector2d& translation() const { return translation_; }
  const std::complex<double>& rotation() const { return rotation_; }
  Eigen::Matrix2d rotation_matrix() const;

  Se2 inverse() const;
  Eigen::Vector3d log() const;      ///< inverse of exp; yaw in (-pi, pi]
  Eigen::Matrix3d adjoint() const;  ///< T exp(t) T^-1 = exp(adjoint * t)
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const;
  Se2 operator*(const Se2& other) const;

 private:
  Eigen::Vector2d translation_ = Eigen::Vector2d::Zero();
  std::complex<double> rotation_ = 1.0;
};

/// The pose a share (0..1) of the way along the constant-twist path between two poses.
Se2 interpolate(const Se2& from, const Se2& to, double share);

}  // namespace sketchloc

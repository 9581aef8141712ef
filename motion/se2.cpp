#include "motion/se2.hpp"

#include "motion/check.hpp"
#include "motion/detail/complex_plane.hpp"

namespace sketchloc {

using detail::exp_quotient;
using detail::to_complex;
using detail::to_vector;

Se2 Se2::from_xy_yaw(double x_m, double y_m, double yaw_rad) {
  Se2 pose;
  pose.translation_ = {x_m, y_m};
  pose.rotation_ = std::polar(1.0, yaw_rad);
  return pose;
}

Se2 Se2::exp(const Eigen::Vector3d& twist) {
  Se2 pose;
  const std::complex<double> w(0.0, twist.z());
  pose.translation_ = to_vector(exp_quotient(w) * to_complex(twist.head<2>()));
  pose.rotation_ = std::polar(1.0, twist.z());
  return pose;
}

Se2 Se2::from_parts(const Eigen::Vector2d& translation_m, const std::complex<double>& rotation) {
  check(std::abs(std::abs(rotation) - 1.0) < 1e-6, "a rotation has unit length");
  Se2 pose;
  pose.translation_ = translation_m;
  pose.rotation_ = rotation;
  return pose;
}

double Se2::yaw_rad() const { return detail::angle_rad(rotation_); }

Eigen::Matrix2d Se2::rotation_matrix() const { return detail::multiplication_matrix(rotation_); }

Se2 Se2::inverse() const {
  Se2 result;
  result.rotation_ = std::conj(rotation_);
  result.translation_ = to_vector(-result.rotation_ * to_complex(translation_));
  return result;
}

Eigen::Vector3d Se2::log() const {
  const double yaw = yaw_rad();
  const Eigen::Vector2d velocity =
      to_vector(to_complex(translation_) / exp_quotient(std::complex<double>(0.0, yaw)));
  return {velocity.x(), velocity.y(), yaw};
}

Eigen::Matrix3d Se2::adjoint() const {
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  result.topLeftCorner<2, 2>() = rotation_matrix();
  result(0, 2) = translation_.y();
  result(1, 2) = -translation_.x();
  return result;
}

Eigen::Vector2d Se2::operator*(const Eigen::Vector2d& point) const {
  return to_vector(rotation_ * to_complex(point)) + translation_;
}

Se2 Se2::operator*(const Se2& other) const {
  Se2 result;
  result.translation_ = *this * other.translation_;
  const std::complex<double> product = rotation_ * other.rotation_;
  result.rotation_ = product / std::abs(product);  // long chains must not shrink
  return result;
}

Se2 interpolate(const Se2& from, const Se2& to, double share) {
  const Eigen::Vector3d twist = (from.inverse() * to).log();
  return from * Se2::exp(share * twist);
}

}  // namespace sketchloc

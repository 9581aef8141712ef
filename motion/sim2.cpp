#include "motion/sim2.hpp"

#include "motion/check.hpp"
#include "motion/detail/complex_plane.hpp"

namespace sketchloc {

using detail::exp_quotient;
using detail::to_complex;
using detail::to_vector;

Sim2 Sim2::from_xy_yaw_scale(double x, double y, double yaw_rad, double scale) {
  check(scale > 0.0, "the scale of a Sim2 must be positive");
  Sim2 result;
  result.translation_ = {x, y};
  result.scaled_rotation_ = std::polar(scale, yaw_rad);
  return result;
}

Sim2 Sim2::from_se2(const Se2& rigid, double scale) {
  return from_xy_yaw_scale(rigid.x_m(), rigid.y_m(), rigid.yaw_rad(), scale);
}

Sim2 Sim2::exp(const Eigen::Vector4d& twist) {
  Sim2 result;
  const std::complex<double> w(twist[3], twist[2]);
  result.translation_ = to_vector(exp_quotient(w) * to_complex(twist.head<2>()));
  result.scaled_rotation_ = std::exp(w);
  return result;
}

Sim2 Sim2::from_parts(const Eigen::Vector2d& translation,
                      const std::complex<double>& scaled_rotation) {
  check(std::abs(scaled_rotation) > 0.0, "the scale of a Sim2 must be positive");
  Sim2 result;
  result.translation_ = translation;
  result.scaled_rotation_ = scaled_rotation;
  return result;
}

double Sim2::yaw_rad() const { return detail::angle_rad(scaled_rotation_); }

Eigen::Matrix2d Sim2::scaled_rotation_matrix() const {
  return detail::multiplication_matrix(scaled_rotation_);
}

Sim2 Sim2::inverse() const {
  Sim2 result;
  result.scaled_rotation_ = 1.0 / scaled_rotation_;
  result.translation_ = to_vector(-result.scaled_rotation_ * to_complex(translation_));
  return result;
}

Eigen::Vector4d Sim2::log() const {
  const std::complex<double> w(std::log(scale()), yaw_rad());
  const Eigen::Vector2d velocity = to_vector(to_complex(translation_) / exp_quotient(w));
  return {velocity.x(), velocity.y(), w.imag(), w.real()};
}

Eigen::Matrix4d Sim2::adjoint() const {
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<2, 2>() = scaled_rotation_matrix();
  result.block<2, 1>(0, 2) << translation_.y(), -translation_.x();
  result.block<2, 1>(0, 3) = -translation_;
  return result;
}

Eigen::Vector2d Sim2::operator*(const Eigen::Vector2d& point) const {
  return to_vector(scaled_rotation_ * to_complex(point)) + translation_;
}

Sim2 Sim2::operator*(const Sim2& other) const {
  Sim2 result;
  result.translation_ = *this * other.translation_;
  result.scaled_rotation_ = scaled_rotation_ * other.scaled_rotation_;
  return result;
}

Sim2 Sim2::operator*(const Se2& other) const { return *this * Sim2::from_se2(other); }

Sim2 interpolate(const Sim2& from, const Sim2& to, double share) {
  const Eigen::Vector4d twist = (from.inverse() * to).log();
  return from * Sim2::exp(share * twist);
}

}  // namespace sketchloc

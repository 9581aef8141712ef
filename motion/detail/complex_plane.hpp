#pragma once

#include <Eigen/Core>
#include <complex>
#include <numbers>

namespace sketchloc::detail {

/// The plane as complex numbers: a rotation with scale is one multiplication.
inline std::complex<double> to_complex(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }
inline Eigen::Vector2d to_vector(const std::complex<double>& z) { return {z.real(), z.imag()}; }

inline Eigen::Matrix2d multiplication_matrix(const std::complex<double>& z) {
  Eigen::Matrix2d matrix;
  matrix << z.real(), -z.imag(), z.imag(), z.real();
  return matrix;
}

/// The argument in (-pi, pi]; std::arg alone gives -pi just below the negative real axis.
inline double angle_rad(const std::complex<double>& z) {
  const double angle = std::arg(z);
  return angle <= -std::numbers::pi ? std::numbers::pi : angle;
}

/// (e^w - 1) / w, the translation part of the exponential maps of SE(2) (w = i yaw) and Sim(2)
/// (w = log scale + i yaw). By its series where the quotient would cancel.
inline std::complex<double> exp_quotient(const std::complex<double>& w) {
  constexpr double kSeriesBelow = 1e-2;
  if (std::abs(w) >= kSeriesBelow) {
    return (std::exp(w) - 1.0) / w;
  }
  std::complex<double> sum = 1.0;
  for (int n = 8; n >= 2; --n) {  // Horner: 1 + w/2 (1 + w/3 (1 + ...)), w^8/9! < 1e-21
    sum = 1.0 + w / static_cast<double>(n) * sum;
  }
  return sum;
}

}  // namespace sketchloc::detail

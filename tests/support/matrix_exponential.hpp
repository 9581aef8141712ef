#pragma once

#include <Eigen/Core>
#include <cmath>

namespace sketchloc::testing {

/// The slow, obvious matrix exponential: power series of A / 2^k, squared k times. Oracle for the
/// closed forms of Se2 and Sim2.
inline Eigen::Matrix3d matrix_exponential(const Eigen::Matrix3d& generator) {
  const int halvings = std::max(0, 3 + static_cast<int>(std::log2(1e-9 + generator.norm())));
  const Eigen::Matrix3d small = generator / std::exp2(halvings);
  Eigen::Matrix3d term = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Identity();
  for (int n = 1; n <= 20; ++n) {
    term = (term * small / n).eval();
    sum += term;
  }
  for (int i = 0; i < halvings; ++i) {
    sum = (sum * sum).eval();
  }
  return sum;
}

}  // namespace sketchloc::testing

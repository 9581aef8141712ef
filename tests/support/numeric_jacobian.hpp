#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace sketchloc::testing {

/// Central differences of a function R^N -> R^M at a point, the independent answer for a Jacobian;
/// column j is the derivative along component j. The function returns a vector, not an expression.
template <typename Function, int N>
auto numeric_jacobian(const Function& function, const Eigen::Matrix<double, N, 1>& point,
                      double step = 1e-5) {
  using Point = Eigen::Matrix<double, N, 1>;
  using Value = std::remove_cvref_t<std::invoke_result_t<Function, const Point&>>;
  Eigen::Matrix<double, Value::RowsAtCompileTime, N> jacobian;
  for (int j = 0; j < N; ++j) {
    const Point offset = step * Point::Unit(j);
    const Value ahead = function(point + offset);
    const Value behind = function(point - offset);
    jacobian.col(j) = (ahead - behind) / (2.0 * step);
  }
  return jacobian;
}

}  // namespace sketchloc::testing

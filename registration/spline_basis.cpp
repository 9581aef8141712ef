#include "registration/spline_basis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "registration/tps.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastSquare = 1e-12;  ///< a hair's width, squared

/// U(r) = r^2 log r^2 and its derivatives at an offset from a control point. [Chen20]
struct Radial {
  double value;
  double x;
  double y;
  double xx;
  double xy;
  double yy;
};

Radial radial(const Eigen::Vector2d& offset) {
  const double square = std::max(offset.squaredNorm(), kLeastSquare);
  const double log_square = std::log(square);
  const double slope = 2.0 * (log_square + 1.0);
  return {.value = square * log_square,
          .x = slope * offset.x(),
          .y = slope * offset.y(),
          .xx = slope + 4.0 * offset.x() * offset.x() / square,
          .xy = 4.0 * offset.x() * offset.y() / square,
          .yy = slope + 4.0 * offset.y() * offset.y() / square};
}

}  // namespace

std::optional<SplineBasis> SplineBasis::over(std::vector<Eigen::Vector2d> control_points) {
  const std::optional<TpsSolver> solver = TpsSolver::factor(control_points);
  if (!solver) {
    return std::nullopt;
  }
  const auto size = static_cast<Eigen::Index>(control_points.size());
  SplineBasis basis;
  basis.coefficients_.resize(size + 3, size);
  std::vector<Eigen::Vector2d> values(control_points.size(), Eigen::Vector2d::Zero());
  for (Eigen::Index i = 0; i < size; ++i) {
    values[static_cast<std::size_t>(i)].x() = 1.0;
    const ThinPlateSpline response = solver->solve(values);
    values[static_cast<std::size_t>(i)].x() = 0.0;
    basis.coefficients_.col(i) << response.weights_.col(0), response.affine_.col(0);
  }
  const Eigen::MatrixXd weights = basis.coefficients_.topRows(size);
  basis.bending_ = 0.5 * (weights + weights.transpose());
  basis.control_points_ = std::move(control_points);
  return basis;
}

SplineBasis::At SplineBasis::at(const Eigen::Vector2d& point) const {
  const auto size = static_cast<Eigen::Index>(control_points_.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> terms =
      Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(size + 3, 6);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Radial u = radial(point - control_points_[static_cast<std::size_t>(i)]);
    terms.row(i) << u.value, u.x, u.y, u.xx, u.xy, u.yy;
  }
  terms.block<3, 3>(size, 0) << 1.0, 0.0, 0.0, point.x(), 1.0, 0.0, point.y(), 0.0, 1.0;
  const Eigen::Matrix<double, Eigen::Dynamic, 6> all = coefficients_.transpose() * terms;
  return {.value = all.col(0),
          .x = all.col(1),
          .y = all.col(2),
          .xx = all.col(3),
          .xy = all.col(4),
          .yy = all.col(5)};
}

}  // namespace sketchloc

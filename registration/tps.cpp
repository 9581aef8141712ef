#include "registration/tps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr std::size_t kInversionStarts = 4;  ///< control points tried when the guess fails

/// U(r) = r^2 log r^2 by r^2, continuous at 0. [Chen20]
double radial(double squared_distance) {
  return squared_distance > 0.0 ? squared_distance * std::log(squared_distance) : 0.0;
}

/// dU/dp = 2 (log r^2 + 1) (p - c); its limit at the control point is 0.
Eigen::Vector2d radial_gradient(const Eigen::Vector2d& offset) {
  const double squared_distance = offset.squaredNorm();
  if (!(squared_distance > 0.0)) {
    return Eigen::Vector2d::Zero();
  }
  return 2.0 * (std::log(squared_distance) + 1.0) * offset;
}

Eigen::Index count(const Points& points) { return static_cast<Eigen::Index>(points.size()); }

Eigen::Vector2d mean(const Points& points) {
  const Eigen::Vector2d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector2d(Eigen::Vector2d::Zero()));
  return sum / static_cast<double>(points.size());
}

double largest_distance(const Points& points, const Eigen::Vector2d& from) {
  double largest = 0.0;
  for (const Eigen::Vector2d& point : points) {
    largest = std::max(largest, (point - from).norm());
  }
  return largest;
}

/// A = [[K + smoothing I, P], [P^T, 0]] with K_jk = U(distance), rows of P = [1 x y]. [Chen20]
Eigen::MatrixXd system_matrix(const Points& points, double smoothing) {
  const Eigen::Index size = count(points);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size + 3, size + 3);
  for (Eigen::Index row = 0; row < size; ++row) {
    const Eigen::Vector2d& point = points[static_cast<std::size_t>(row)];
    for (Eigen::Index column = 0; column < size; ++column) {
      const Eigen::Vector2d& other = points[static_cast<std::size_t>(column)];
      system(row, column) = radial((point - other).squaredNorm());
    }
    system(row, row) += smoothing;
    system.block<1, 3>(row, size) << 1.0, point.x(), point.y();
    system.block<3, 1>(size, row) << 1.0, point.x(), point.y();
  }
  return system;
}

}  // namespace

Eigen::Vector2d ThinPlateSpline::operator()(const Eigen::Vector2d& point) const {
  Eigen::Vector2d value = affine_.transpose() * Eigen::Vector3d(1.0, point.x(), point.y());
  for (std::size_t i = 0; i < control_points_.size(); ++i) {
    const double weight = radial((point - control_points_[i]).squaredNorm());
    value += weight * weights_.row(static_cast<Eigen::Index>(i)).transpose();
  }
  return value;
}

Eigen::Matrix2d ThinPlateSpline::jacobian(const Eigen::Vector2d& point) const {
  Eigen::Matrix2d jacobian = affine_.bottomRows<2>().transpose();
  for (std::size_t i = 0; i < control_points_.size(); ++i) {
    const Eigen::Vector2d gradient = radial_gradient(point - control_points_[i]);
    jacobian += weights_.row(static_cast<Eigen::Index>(i)).transpose() * gradient.transpose();
  }
  return jacobian;
}

PlaneMapPoint ThinPlateSpline::at(const Eigen::Vector2d& point) const {
  return {(*this)(point), jacobian(point)};
}

double ThinPlateSpline::bending_energy() const {
  // The biharmonic operator takes U to 16 pi delta, so the energy is 16 pi w^T K w.
  const Eigen::Index size = count(control_points_);
  const Eigen::MatrixXd kernel = system_matrix(control_points_, 0.0).topLeftCorner(size, size);
  const double quadratic = (weights_.transpose() * kernel * weights_).trace();
  return 16.0 * std::numbers::pi * std::max(quadratic, 0.0);
}

std::optional<TpsSolver> TpsSolver::factor(Points control_points, double smoothing) {
  check(smoothing >= 0.0, "smoothing is not negative");
  if (control_points.size() < 3) {
    return std::nullopt;
  }
  TpsSolver solver;
  solver.centre_ = mean(control_points);
  solver.spread_ = largest_distance(control_points, solver.centre_);
  if (!(solver.spread_ > 0.0) || !std::isfinite(solver.spread_)) {
    return std::nullopt;
  }
  Points normalised;
  normalised.reserve(control_points.size());
  for (const Eigen::Vector2d& point : control_points) {
    normalised.push_back((point - solver.centre_) / solver.spread_);
  }
  solver.system_.setThreshold(1e-11);
  solver.system_.compute(system_matrix(normalised, smoothing / (solver.spread_ * solver.spread_)));
  if (!solver.system_.isInvertible()) {
    return std::nullopt;
  }
  solver.control_points_ = std::move(control_points);
  return solver;
}

ThinPlateSpline TpsSolver::solve(std::span<const Eigen::Vector2d> values) const {
  check(values.size() == control_points_.size(), "a spline needs one value per control point");
  const Eigen::Index size = count(control_points_);
  Eigen::Matrix<double, Eigen::Dynamic, 2> right_side =
      Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(size + 3, 2);
  for (Eigen::Index i = 0; i < size; ++i) {
    right_side.row(i) = values[static_cast<std::size_t>(i)].transpose();
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 2> solution = system_.solve(right_side);

  ThinPlateSpline spline;
  spline.control_points_ = control_points_;
  // Back to plain coordinates: U(r / s) = U(r) / s^2 - r^2 log(s^2) / s^2, and by the side
  // conditions (sum w = 0, sum w c = 0) the last term adds up to a constant.
  const double squared_spread = spread_ * spread_;
  spline.weights_ = solution.topRows(size) / squared_spread;
  Eigen::RowVector2d constant = Eigen::RowVector2d::Zero();
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Vector2d offset = control_points_[static_cast<std::size_t>(i)] - centre_;
    constant -= spline.weights_.row(i) * offset.squaredNorm() * std::log(squared_spread);
  }
  spline.affine_.bottomRows<2>() = solution.bottomRows<2>() / spread_;
  spline.affine_.row(0) =
      solution.row(size) + constant - centre_.transpose() * spline.affine_.bottomRows<2>();
  return spline;
}

Inversion invert(const ThinPlateSpline& spline, const Eigen::Vector2d& target,
                 const Eigen::Vector2d& guess, const InversionParams& params) {
  Points nearest = spline.control_points();
  const std::size_t kept = std::min(kInversionStarts, nearest.size());
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(kept),
                    nearest.end(), [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                      return (spline(a) - target).squaredNorm() <
                             (spline(b) - target).squaredNorm();
                    });
  Points starts{guess};
  starts.insert(starts.end(), nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(kept));
  return invert([&](const Eigen::Vector2d& point) { return spline.at(point); }, target, starts,
                params);
}

FoldReport find_folds(const ThinPlateSpline& spline, const PlaneBox& box, int samples_per_side) {
  return find_folds([&](const Eigen::Vector2d& point) { return spline.at(point); }, box,
                    samples_per_side);
}

}  // namespace sketchloc

#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <optional>
#include <span>
#include <vector>

#include "registration/plane_map.hpp"

namespace sketchloc {

/// Thin plate spline from the plane to the plane: the map through given points that bends least.
/// [Chen20] f(p) = a1 + a2 x + a3 y + sum_i w_i U(|p - c_i|), U(r) = r^2 log r^2. Made by
/// TpsSolver.
class ThinPlateSpline {
 public:
  Eigen::Vector2d operator()(const Eigen::Vector2d& point) const;
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& point) const;
  PlaneMapPoint at(const Eigen::Vector2d& point) const;

  /// Integral over the plane of f_xx^2 + 2 f_xy^2 + f_yy^2, both components; 0 for affine maps.
  double bending_energy() const;

  const std::vector<Eigen::Vector2d>& control_points() const { return control_points_; }

 private:
  friend class TpsSolver;
  friend class SplineBasis;
  std::vector<Eigen::Vector2d> control_points_;
  Eigen::Matrix<double, Eigen::Dynamic, 2> weights_;  ///< w, one row per control point
  Eigen::Matrix<double, 3, 2> affine_;                ///< a: rows 1, x, y
};

/// The linear system of splines over fixed control points, factored once for many right-hand sides.
class TpsSolver {
 public:
  /// None where no spline is defined: fewer than 3 points, all on one line, or (without smoothing)
  /// two in one place. `smoothing` >= 0, in squared units of the control points, lets the spline
  /// miss the values to bend less: it minimises sum |f(c_i) - v_i|^2 + smoothing * energy / 16 pi.
  static std::optional<TpsSolver> factor(std::vector<Eigen::Vector2d> control_points,
                                         double smoothing = 0.0);

  /// The spline with f(c_i) = values[i] (nearly, with smoothing); checks the count.
  ThinPlateSpline solve(std::span<const Eigen::Vector2d> values) const;

 private:
  TpsSolver() = default;

  std::vector<Eigen::Vector2d> control_points_;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  double spread_ = 1.0;  ///< the system is solved in (p - centre) / spread, for its condition
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> system_;
};

/// The point that the spline takes to a target: Newton from the guess, then from the control points
/// whose images lie nearest to the target.
Inversion invert(const ThinPlateSpline& spline, const Eigen::Vector2d& target,
                 const Eigen::Vector2d& guess, const InversionParams& params = {});

/// As find_folds of any map.
FoldReport find_folds(const ThinPlateSpline& spline, const PlaneBox& box, int samples_per_side);

}  // namespace sketchloc

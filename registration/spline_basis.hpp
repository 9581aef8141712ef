#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace sketchloc {

/// What thin plate splines over fixed control points are made of, for those who look for the
/// values: everything about such a spline is linear in its values v, one component at a time.
class SplineBasis {
 public:
  /// None where no spline is defined (TpsSolver).
  static std::optional<SplineBasis> over(std::vector<Eigen::Vector2d> control_points);

  /// f(p) = value . v, and its derivatives by p: first and second ones.
  struct At {
    Eigen::VectorXd value;
    Eigen::VectorXd x;
    Eigen::VectorXd y;
    Eigen::VectorXd xx;
    Eigen::VectorXd xy;
    Eigen::VectorXd yy;
  };
  /// At a control point, where second derivatives have no limit, they are those of a hair beside
  /// it.
  At at(const Eigen::Vector2d& point) const;

  /// The bending energy of a component is v^T B v times a constant; B is symmetric and positive
  /// semidefinite, 0 for affine maps only.
  const Eigen::MatrixXd& bending() const { return bending_; }

  const std::vector<Eigen::Vector2d>& control_points() const { return control_points_; }

 private:
  SplineBasis() = default;

  std::vector<Eigen::Vector2d> control_points_;
  Eigen::MatrixXd coefficients_;  ///< weights and affine part by values: (n + 3) x n
  Eigen::MatrixXd bending_;       ///< n x n
};

}  // namespace sketchloc

#include "registration/control_grid.hpp"

#include <optional>

#include "motion/check.hpp"
#include "registration/tps.hpp"

namespace sketchloc {

std::vector<Eigen::Vector2d> square_lattice(int points_per_side, double side,
                                            const Eigen::Vector2d& centre) {
  check(points_per_side >= 2, "a lattice has corners");
  const double spacing = side / (points_per_side - 1);
  std::vector<Eigen::Vector2d> points;
  for (int row = 0; row < points_per_side; ++row) {
    for (int column = 0; column < points_per_side; ++column) {
      points.emplace_back(centre.x() - 0.5 * side + column * spacing,
                          centre.y() - 0.5 * side + row * spacing);
    }
  }
  return points;
}

Eigen::MatrixXd spline_matrix(std::span<const Eigen::Vector2d> control_points,
                              std::span<const Eigen::Vector2d> points) {
  const std::optional<TpsSolver> solver =
      TpsSolver::factor({control_points.begin(), control_points.end()});
  check(solver.has_value(), "the control points define a spline");
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(points.size()),
                         static_cast<Eigen::Index>(control_points.size()));
  for (std::size_t control = 0; control < control_points.size(); ++control) {
    std::vector<Eigen::Vector2d> values(control_points.size(), Eigen::Vector2d::Zero());
    values[control] = Eigen::Vector2d(1.0, 0.0);
    const ThinPlateSpline response = solver->solve(values);
    for (std::size_t i = 0; i < points.size(); ++i) {
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(control)) =
          response(points[i]).x();
    }
  }
  return matrix;
}

}  // namespace sketchloc

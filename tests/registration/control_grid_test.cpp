#include "registration/control_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "registration/tps.hpp"

namespace sketchloc {
namespace {

TEST(ControlGrid, SpansTheSquareRowByRow) {
  const std::vector<Eigen::Vector2d> points = square_lattice(4, 6.0, {1.0, 0.0});
  ASSERT_EQ(points.size(), 16U);
  EXPECT_TRUE(points.front().isApprox(Eigen::Vector2d(-2.0, -3.0)));
  EXPECT_TRUE(points[1].isApprox(Eigen::Vector2d(0.0, -3.0)));
  EXPECT_TRUE(points.back().isApprox(Eigen::Vector2d(4.0, 3.0)));
}

TEST(ControlGrid, MatrixEvaluatesTheSpline) {
  const std::vector<Eigen::Vector2d> controls = square_lattice(4, 6.0, {0.0, 0.0});
  const std::vector<Eigen::Vector2d> points = square_lattice(5, 7.0, {0.3, -0.2});
  std::vector<Eigen::Vector2d> values;
  for (const Eigen::Vector2d& control : controls) {
    values.emplace_back(std::sin(control.x()) + control.y(), std::cos(control.y() * control.x()));
  }
  const ThinPlateSpline spline = TpsSolver::factor(controls)->solve(values);
  const Eigen::MatrixXd matrix = spline_matrix(controls, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t j = 0; j < values.size(); ++j) {
      sum += matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * values[j];
    }
    EXPECT_LT((sum - spline(points[i])).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace sketchloc

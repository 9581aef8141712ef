#include "registration/spline_basis.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "motion/random.hpp"
#include "registration/control_grid.hpp"
#include "registration/tps.hpp"

namespace sketchloc {
namespace {

std::vector<Eigen::Vector2d> random_points(std::size_t count, double size, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = size * uniform(rng);
    points.emplace_back(x, size * uniform(rng));
  }
  return points;
}

TEST(SplineBasis, GivesTheSplineThroughTheValues) {
  const std::vector<Eigen::Vector2d> controls = random_points(40, 30.0, 1);
  const std::vector<Eigen::Vector2d> values = random_points(40, 500.0, 2);
  const auto basis = SplineBasis::over(controls);
  ASSERT_TRUE(basis);
  const ThinPlateSpline spline = TpsSolver::factor(controls)->solve(values);
  Eigen::Matrix<double, Eigen::Dynamic, 2> stacked(40, 2);
  for (Eigen::Index i = 0; i < 40; ++i) {
    stacked.row(i) = values[static_cast<std::size_t>(i)].transpose();
  }
  for (const Eigen::Vector2d& point : random_points(20, 35.0, 3)) {
    const SplineBasis::At at = basis->at(point);
    const PlaneMapPoint expected = spline.at(point);
    EXPECT_LT((stacked.transpose() * at.value - expected.value).norm(), 1e-6);
    EXPECT_LT((stacked.transpose() * at.x - expected.jacobian.col(0)).norm(), 1e-7);
    EXPECT_LT((stacked.transpose() * at.y - expected.jacobian.col(1)).norm(), 1e-7);
  }
  const double energy =
      16.0 * std::numbers::pi * (stacked.transpose() * basis->bending() * stacked).trace();
  EXPECT_NEAR(energy, spline.bending_energy(), 1e-6 * energy);
}

TEST(SplineBasis, GivesSecondDerivatives) {
  constexpr double kStep = 1e-5;
  const auto basis = SplineBasis::over(square_lattice(5, 20.0, {3.0, -2.0}));
  ASSERT_TRUE(basis);
  const Eigen::Vector2d point(4.3, 1.7);
  const SplineBasis::At at = basis->at(point);
  const SplineBasis::At right = basis->at(point + Eigen::Vector2d(kStep, 0.0));
  const SplineBasis::At up = basis->at(point + Eigen::Vector2d(0.0, kStep));
  EXPECT_LT(((right.x - at.x) / kStep - at.xx).norm(), 1e-4);
  EXPECT_LT(((right.y - at.y) / kStep - at.xy).norm(), 1e-4);
  EXPECT_LT(((up.y - at.y) / kStep - at.yy).norm(), 1e-4);
}

TEST(SplineBasis, IsFiniteAtAControlPoint) {
  const std::vector<Eigen::Vector2d> controls = square_lattice(3, 2.0, {0.0, 0.0});
  const auto basis = SplineBasis::over(controls);
  ASSERT_TRUE(basis);
  const SplineBasis::At at = basis->at(controls[4]);
  EXPECT_NEAR(at.value[4], 1.0, 1e-9);
  EXPECT_TRUE(at.xx.allFinite() && at.xy.allFinite() && at.yy.allFinite());
}

TEST(SplineBasis, NeedsAPlane) {
  EXPECT_FALSE(SplineBasis::over({}));
  EXPECT_FALSE(SplineBasis::over({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}));
}

}  // namespace
}  // namespace sketchloc

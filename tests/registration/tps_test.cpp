#include "registration/tps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "motion/random.hpp"
#include "tests/support/numeric_jacobian.hpp"

namespace sketchloc {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points grid_points(int per_side, double spacing) {
  Points points;
  for (int row = 0; row < per_side; ++row) {
    for (int column = 0; column < per_side; ++column) {
      points.emplace_back(column * spacing, row * spacing);
    }
  }
  return points;
}

Points moved(Points points, double sigma, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  for (Eigen::Vector2d& point : points) {
    point.x() += gaussian(sigma, rng);
    point.y() += gaussian(sigma, rng);
  }
  return points;
}

/// A lively but unfolded spline over [0, 300]^2.
ThinPlateSpline bent_spline() {
  const Points control_points = grid_points(4, 100.0);
  return TpsSolver::factor(control_points)->solve(moved(control_points, 12.0, 3));
}

TEST(Tps, PassesThroughItsValues) {
  const Points control_points = grid_points(4, 100.0);
  const Points values = moved(control_points, 20.0, 7);
  const ThinPlateSpline spline = TpsSolver::factor(control_points)->solve(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_LT((spline(control_points[i]) - values[i]).norm(), 1e-9);
  }
}

TEST(Tps, ServesManyRightSidesFromOneFactorisation) {
  const Points control_points = grid_points(3, 1.0);
  const std::optional<TpsSolver> solver = TpsSolver::factor(control_points);
  ASSERT_TRUE(solver.has_value());
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Points values = moved(control_points, 0.3, seed);
    EXPECT_LT((solver->solve(values)(control_points[4]) - values[4]).norm(), 1e-11);
  }
}

TEST(Tps, IsAffineWhereTheValuesAreAffine) {
  Eigen::Matrix2d linear;
  linear << 2.0, -0.7, 0.3, 1.5;
  const Eigen::Vector2d shift(-40.0, 8.0);
  const Points control_points = moved(grid_points(4, 100.0), 25.0, 1);
  Points values;
  for (const Eigen::Vector2d& point : control_points) {
    values.push_back(linear * point + shift);
  }
  const ThinPlateSpline spline = TpsSolver::factor(control_points)->solve(values);
  const Eigen::Vector2d far_away(1234.0, -777.0);
  EXPECT_LT((spline(far_away) - (linear * far_away + shift)).norm(), 1e-7);
  EXPECT_TRUE(spline.jacobian(far_away).isApprox(linear, 1e-9));
  EXPECT_NEAR(spline.bending_energy(), 0.0, 1e-9);
}

TEST(Tps, HasTheJacobianOfItsValue) {
  const ThinPlateSpline spline = bent_spline();
  const Points points = {{150.0, 120.0}, {1.0, 299.0}, {-50.0, 400.0}, {100.0, 200.0}};
  for (const Eigen::Vector2d& point : points) {  // the last is a control point
    EXPECT_TRUE(spline.jacobian(point).isApprox(testing::numeric_jacobian(spline, point), 1e-6));
    EXPECT_EQ(spline.at(point).value, spline(point));
    EXPECT_EQ(spline.at(point).jacobian, spline.jacobian(point));
  }
}

TEST(Tps, DoesNotDependOnTheUnitOfThePlane) {
  const Points small = grid_points(4, 1.0);
  const Points values = moved(small, 0.2, 5);
  const ThinPlateSpline spline = TpsSolver::factor(small)->solve(values);
  const double unit = 1000.0;
  Points large;
  for (const Eigen::Vector2d& point : small) {
    large.push_back(unit * point);
  }
  const ThinPlateSpline scaled = TpsSolver::factor(large)->solve(values);
  const Eigen::Vector2d point(0.4, 2.2);
  EXPECT_LT((spline(point) - scaled(unit * point)).norm(), 1e-9);
}

/// Second derivatives by differences of the (tested) Jacobian.
double energy_density(const ThinPlateSpline& spline, const Eigen::Vector2d& point) {
  const double step = 1e-4;
  double sum = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d offset = step * Eigen::Vector2d::Unit(axis);
    const Eigen::Matrix2d second =
        (spline.jacobian(point + offset) - spline.jacobian(point - offset)) / (2.0 * step);
    sum += second.squaredNorm();
  }
  return sum;
}

TEST(Tps, HasTheBendingEnergyOfANumericIntegral) {
  const Points control_points = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {0.4, 0.6}};
  Points values = control_points;
  values.back() += Eigen::Vector2d(0.2, -0.1);
  const ThinPlateSpline spline = TpsSolver::factor(control_points)->solve(values);
  const double half_side = 8.0;  // the density falls with r^-4 or faster
  const double step = 0.05;
  double integral = 0.0;
  for (double x = -half_side + step / 2; x < half_side; x += step) {
    for (double y = -half_side + step / 2; y < half_side; y += step) {
      integral += energy_density(spline, {x + 0.5, y + 0.5}) * step * step;
    }
  }
  EXPECT_NEAR(spline.bending_energy() / integral, 1.0, 0.02);
}

TEST(Tps, BendsLessAndMissesMoreWithSmoothing) {
  const Points control_points = grid_points(5, 1.0);
  const Points values = moved(control_points, 0.3, 11);
  double energy_before = std::numeric_limits<double>::infinity();
  double miss_before = -1.0;
  for (const double smoothing : {0.0, 0.1, 10.0, 1e6}) {
    const ThinPlateSpline spline = TpsSolver::factor(control_points, smoothing)->solve(values);
    double miss = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      miss += (spline(control_points[i]) - values[i]).squaredNorm();
    }
    EXPECT_LT(spline.bending_energy(), energy_before);
    EXPECT_GT(miss, miss_before);
    energy_before = spline.bending_energy();
    miss_before = miss;
  }
}

TEST(Tps, MinimisesWhatItsSmoothingSays) {
  const Points control_points = grid_points(3, 1.0);
  const Points values = moved(control_points, 0.3, 13);
  const double smoothing = 0.7;
  const auto cost = [&](const ThinPlateSpline& spline) {
    double sum = smoothing * spline.bending_energy() / (16.0 * std::numbers::pi);
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += (spline(control_points[i]) - values[i]).squaredNorm();
    }
    return sum;
  };
  const ThinPlateSpline best = TpsSolver::factor(control_points, smoothing)->solve(values);
  const std::optional<TpsSolver> exact = TpsSolver::factor(control_points);
  for (std::size_t i = 0; i < values.size(); ++i) {
    Points nudged;
    for (const Eigen::Vector2d& point : control_points) {
      nudged.push_back(best(point));
    }
    nudged[i].x() += 1e-3;
    EXPECT_GT(cost(exact->solve(nudged)), cost(best));
  }
}

TEST(Tps, IsUndefinedForTooFewCollinearOrCoincidentPoints) {
  EXPECT_FALSE(TpsSolver::factor({}).has_value());
  EXPECT_FALSE(TpsSolver::factor({{0.0, 0.0}, {1.0, 0.0}}).has_value());
  EXPECT_FALSE(TpsSolver::factor({{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}, {5.0, 5.0}}).has_value());
  EXPECT_FALSE(TpsSolver::factor({{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}).has_value());
  EXPECT_FALSE(TpsSolver::factor({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, 1.0}}).has_value());
  EXPECT_TRUE(TpsSolver::factor({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.0, 1.0}}, 0.1).has_value());
  EXPECT_TRUE(TpsSolver::factor({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}).has_value());
}

TEST(Tps, InverseUndoesTheSpline) {
  const ThinPlateSpline spline = bent_spline();
  for (double x = 5.0; x < 300.0; x += 49.0) {
    for (double y = 5.0; y < 300.0; y += 49.0) {
      const Eigen::Vector2d point(x, y);
      const Inversion inversion = invert(spline, spline(point), {150.0, 150.0});
      EXPECT_EQ(inversion.status, Inversion::Status::Converged);
      EXPECT_LT((inversion.point - point).norm(), 1e-6);
    }
  }
}

TEST(Tps, ShowsWhereItFolds) {
  EXPECT_FALSE(find_folds(bent_spline(), {{0.0, 0.0}, {300.0, 300.0}}, 60).folds());
  const Points control_points = grid_points(4, 100.0);
  Points swapped = control_points;
  std::swap(swapped[5], swapped[6]);
  const ThinPlateSpline folded = TpsSolver::factor(control_points)->solve(swapped);
  EXPECT_TRUE(find_folds(folded, {{0.0, 0.0}, {300.0, 300.0}}, 60).folds());
}

}  // namespace
}  // namespace sketchloc

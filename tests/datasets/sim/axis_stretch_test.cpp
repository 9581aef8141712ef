#include "datasets/sim/axis_stretch.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "motion/random.hpp"
#include "tests/support/numeric_jacobian.hpp"

namespace sketchloc {
namespace {

/// Rates that differ by a factor of 20 between neighbours.
AxisStretch wild_stretch(int axis) {
  Rng rng = make_rng(5);
  Grid<double> rates(8, 5);
  for (int row = 0; row < rates.height(); ++row) {
    for (double& rate : rates.row(row)) {
      rate = std::exp(uniform(-1.5, 1.5, rng));
    }
  }
  const AxisStretch::Lattice lattice = {.axis = axis, .low = {-1.0, 2.0}, .along = 0.5};
  return {lattice, std::move(rates), {0.0, 0.5, -0.3, 0.2, 0.1}};
}

class AxisStretchLaws : public ::testing::TestWithParam<int> {
 protected:
  std::vector<Eigen::Vector2d> points() const {
    std::vector<Eigen::Vector2d> list;
    for (double x = -3.03; x < 9.0; x += 0.71) {
      for (double y = -3.01; y < 9.0; y += 0.73) {
        list.emplace_back(x, y);
      }
    }
    return list;
  }
};

TEST_P(AxisStretchLaws, HasTheJacobianOfItsValue) {
  const AxisStretch stretch = wild_stretch(GetParam());
  for (const Eigen::Vector2d& point : points()) {
    const Eigen::Matrix2d numeric = testing::numeric_jacobian(
        [&](const Eigen::Vector2d& at) { return stretch.at(at).value; }, point);
    EXPECT_TRUE(stretch.at(point).jacobian.isApprox(numeric, 1e-4)) << point.transpose();
  }
}

TEST_P(AxisStretchLaws, NeverFolds) {
  const AxisStretch stretch = wild_stretch(GetParam());
  for (const Eigen::Vector2d& point : points()) {
    EXPECT_GT(stretch.at(point).jacobian.determinant(), 0.0);
  }
}

TEST_P(AxisStretchLaws, InverseUndoesIt) {
  const AxisStretch stretch = wild_stretch(GetParam());
  for (const Eigen::Vector2d& point : points()) {
    EXPECT_LT((stretch.inverse(stretch.at(point).value) - point).norm(), 1e-9);
  }
}

TEST_P(AxisStretchLaws, LeavesTheOtherAxisAlone) {
  const AxisStretch stretch = wild_stretch(GetParam());
  const int other = 1 - GetParam();
  for (const Eigen::Vector2d& point : points()) {
    EXPECT_EQ(stretch.at(point).value(other), point(other));
  }
}

INSTANTIATE_TEST_SUITE_P(BothAxes, AxisStretchLaws, ::testing::Values(0, 1));

TEST(AxisStretch, WithRateOneAndEqualStartsIsAShift) {
  const AxisStretch stretch({.axis = 0, .low = {2.0, 0.0}}, Grid<double>(4, 3, 1.0),
                            {7.0, 7.0, 7.0});
  const PlaneMapPoint there = stretch.at({3.3, 1.4});
  EXPECT_NEAR(there.value.x(), 8.3, 1e-12);
  EXPECT_TRUE(there.jacobian.isApprox(Eigen::Matrix2d::Identity(), 1e-12));
}

}  // namespace
}  // namespace sketchloc

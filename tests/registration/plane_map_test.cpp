#include "registration/plane_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sketchloc {
namespace {

/// Shears by a sine: invertible everywhere, det J = 1.
PlaneMapPoint sheared(const Eigen::Vector2d& point) {
  Eigen::Matrix2d jacobian;
  jacobian << 1.0, 3.0 * std::cos(point.y()), 0.0, 1.0;
  return {{point.x() + 3.0 * std::sin(point.y()), point.y()}, jacobian};
}

/// Folds along x = 0: det J = 2 x.
PlaneMapPoint folded(const Eigen::Vector2d& point) {
  Eigen::Matrix2d jacobian;
  jacobian << 2.0 * point.x(), 0.0, 0.0, 1.0;
  return {{point.x() * point.x(), point.y()}, jacobian};
}

TEST(InvertPlaneMap, FindsThePointThatGoesToTheTarget) {
  const Eigen::Vector2d point(4.0, -7.0);
  const std::array<Eigen::Vector2d, 1> starts = {Eigen::Vector2d::Zero()};
  const Inversion inversion = invert(sheared, sheared(point).value, starts);
  EXPECT_EQ(inversion.status, Inversion::Status::Converged);
  EXPECT_TRUE(inversion.point.isApprox(point, 1e-9));
}

TEST(InvertPlaneMap, TriesTheNextStartAfterAFold) {
  const std::array<Eigen::Vector2d, 2> starts = {Eigen::Vector2d(0.0, 0.0),
                                                 Eigen::Vector2d(1.0, 0.0)};
  const Inversion inversion = invert(folded, {9.0, 2.0}, starts);
  EXPECT_EQ(inversion.status, Inversion::Status::Converged);
  EXPECT_TRUE(inversion.point.isApprox(Eigen::Vector2d(3.0, 2.0), 1e-9));
}

TEST(InvertPlaneMap, SaysThatEveryStartIsOnAFold) {
  const std::array<Eigen::Vector2d, 1> starts = {Eigen::Vector2d::Zero()};
  EXPECT_EQ(invert(folded, {9.0, 2.0}, starts).status, Inversion::Status::Singular);
}

TEST(InvertPlaneMap, DoesNotPretendToReachATargetOutsideTheImage) {
  const std::array<Eigen::Vector2d, 1> starts = {Eigen::Vector2d(1.0, 0.0)};
  const Inversion inversion = invert(folded, {-1.0, 0.0}, starts);
  EXPECT_NE(inversion.status, Inversion::Status::Converged);
  EXPECT_GE(inversion.error, 1.0);
}

TEST(FindFolds, ReportsTheSmallestDeterminantAndItsPlace) {
  const FoldReport report = find_folds(folded, {{-1.0, 0.0}, {2.0, 1.0}}, 4);
  EXPECT_TRUE(report.folds());
  EXPECT_DOUBLE_EQ(report.min_determinant, -2.0);
  EXPECT_DOUBLE_EQ(report.worst_point.x(), -1.0);
}

TEST(FindFolds, PassesAMapThatKeepsOrientation) {
  EXPECT_FALSE(find_folds(folded, {{0.5, 0.0}, {2.0, 1.0}}, 10).folds());
  EXPECT_NEAR(find_folds(sheared, {{-5.0, -5.0}, {5.0, 5.0}}, 20).min_determinant, 1.0, 1e-12);
}

TEST(FindFolds, TakesNanForAFold) {
  const PlaneMap broken = [](const Eigen::Vector2d& point) -> PlaneMapPoint {
    return {point, Eigen::Matrix2d::Constant(std::nan(""))};
  };
  EXPECT_TRUE(find_folds(broken, {{0.0, 0.0}, {1.0, 1.0}}, 2).folds());
}

}  // namespace
}  // namespace sketchloc

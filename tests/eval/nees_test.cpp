#include "eval/nees.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "motion/random.hpp"

namespace sketchloc {
namespace {

// e = (1, 2), P = [2 1; 1 2]: P^-1 = [2 -1; -1 2] / 3, so e^T P^-1 e = (2 - 4 + 8) / 3 = 2.
TEST(Nees, MeetsTheValueWorkedOutByHand) {
  Eigen::Matrix2d covariance;
  covariance << 2.0, 1.0, 1.0, 2.0;
  const auto value = nees(Eigen::Vector2d(1.0, 2.0), covariance);
  ASSERT_TRUE(value.has_value());
  EXPECT_NEAR(*value, 2.0, 1e-12);
}

TEST(Nees, IsNoneWhereTheCovarianceIsSingular) {
  EXPECT_FALSE(nees(Eigen::Vector2d(1.0, 0.0), Eigen::Matrix2d::Zero()).has_value());
  const Eigen::Matrix2d one_direction = Eigen::Vector2d(1.0, 0.0).asDiagonal();
  EXPECT_FALSE(nees(Eigen::Vector2d(1.0, 0.0), one_direction).has_value());
}

TEST(Nees, OfNothingHasNoSummary) { EXPECT_FALSE(summarize_nees({}, 2.0).has_value()); }

// One value with 2 degrees: the chi-square distribution is 1 - exp(-x / 2).
TEST(Nees, BandsAreChiSquareQuantiles) {
  const auto summary = summarize_nees(std::vector<double>{3.0}, 2.0);
  ASSERT_TRUE(summary.has_value());
  EXPECT_NEAR(summary->mean_band.low, -2.0 * std::log(1.0 - 0.025), 1e-10);
  EXPECT_NEAR(summary->mean_band.high, -2.0 * std::log(1.0 - 0.975), 1e-10);
  EXPECT_NEAR(summary->single_bound, -2.0 * std::log(1.0 - 0.95), 1e-10);
  EXPECT_EQ(summary->share_inside, 1.0);
  EXPECT_EQ(summary->mean, 3.0);
}

// The mean of n chi-square values with d degrees has standard deviation sqrt(2 d / n).
TEST(NeesStatistical, OfAnHonestFilterIsItsDegreesOfFreedom) {
  Eigen::Matrix3d covariance;
  covariance << 4.0, 1.0, 0.2, 1.0, 2.0, -0.3, 0.2, -0.3, 0.5;
  const Eigen::Matrix3d root = covariance.llt().matrixL();
  constexpr int kCount = 4000;
  Rng rng = make_rng(5);
  std::vector<double> values;
  for (int i = 0; i < kCount; ++i) {
    const double x = gaussian(1.0, rng);
    const double y = gaussian(1.0, rng);
    const double z = gaussian(1.0, rng);
    const Eigen::Vector3d error = root * Eigen::Vector3d(x, y, z);
    values.push_back(*nees(error, covariance));
  }
  const auto summary = summarize_nees(values, 3.0);
  EXPECT_NEAR(summary->mean, 3.0, 5.0 * std::sqrt(2.0 * 3.0 / kCount));
  EXPECT_NEAR(summary->share_inside, 0.95, 5.0 * std::sqrt(0.95 * 0.05 / kCount));
}

}  // namespace
}  // namespace sketchloc

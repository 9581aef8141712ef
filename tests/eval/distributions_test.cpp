#include "eval/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sketchloc {
namespace {

TEST(NormalQuantile, MeetsPublishedTables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
  EXPECT_NEAR(normal_quantile(0.95), 1.6448536269514722, 1e-12);
  EXPECT_NEAR(normal_quantile(0.1), -1.2815515655446004, 1e-12);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-12);
  EXPECT_NEAR(normal_quantile(0.5), 0.0, 1e-12);
}

TEST(IncompleteGamma, IsAnExponentialForOneAndAnErrorFunctionForAHalf) {
  for (const double x : {1e-6, 0.1, 1.0, 1.49, 1.51, 5.0, 40.0}) {
    EXPECT_NEAR(incomplete_gamma(1.0, x), 1.0 - std::exp(-x), 1e-14);
    EXPECT_NEAR(incomplete_gamma(0.5, x), std::erf(std::sqrt(x)), 1e-14);
  }
  EXPECT_EQ(incomplete_gamma(2.0, 0.0), 0.0);
}

// Independent values: SciPy 1.10, scipy.special.gammainc.
TEST(IncompleteGamma, StaysExactForLargeArguments) {
  EXPECT_NEAR(incomplete_gamma(3.0, 8.0), 0.986246032255997, 1e-13);
  EXPECT_NEAR(incomplete_gamma(900.0, 880.0), 0.25445437400872745, 1e-11);
  EXPECT_NEAR(incomplete_gamma(900.0, 950.0), 0.9503058568950077, 1e-11);
  EXPECT_NEAR(incomplete_gamma(1e4, 1e4), 0.5013298083399552, 1e-10);
}

// Independent values: SciPy 1.10, scipy.stats.chi2.ppf.
TEST(ChiSquareQuantile, MeetsPublishedTables) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1.0), 3.841458820694124, 1e-10);
  EXPECT_NEAR(chi_square_quantile(0.95, 2.0), 5.991464547107979, 1e-10);
  EXPECT_NEAR(chi_square_quantile(0.05, 3.0), 0.35184631774927144, 1e-11);
  EXPECT_NEAR(chi_square_quantile(0.5, 2.0), 2.0 * std::log(2.0), 1e-12);
  EXPECT_NEAR(chi_square_quantile(0.025, 1820.0), 1703.656198970241, 1e-6);
  EXPECT_NEAR(chi_square_quantile(0.975, 1820.0), 1940.1321133341871, 1e-6);
  EXPECT_EQ(chi_square_quantile(0.0, 2.0), 0.0);
}

TEST(ChiSquareQuantile, UndoesTheProbability) {
  for (const double degrees : {0.5, 1.0, 2.0, 7.0, 300.0}) {
    for (const double probability : {1e-6, 0.2, 0.5, 0.999}) {
      const double x = chi_square_quantile(probability, degrees);
      EXPECT_NEAR(chi_square_probability(x, degrees), probability, 1e-10);
    }
  }
}

TEST(StudentT, InOneDimensionIsThePublishedOne) {
  // SciPy 1.10, scipy.stats.t.ppf(0.975, 4) and (0.84, 6); a scale of 1 has a variance of
  // degrees / (degrees - 2).
  const double at_4 = 2.7764451051977934;
  EXPECT_NEAR(student_t_quantile(0.95, 1, 4), at_4 * at_4 / 2.0, 1e-9);
  const double at_6 = 1.0839756791279657;
  EXPECT_NEAR(student_t_probability(at_6 * at_6 / 1.5, 1, 6), 0.68, 1e-3);
}

TEST(StudentT, HasTheMeanDistanceOfItsCovariance) {
  // E[distance] = dimensions, as the integral of 1 - P.
  double mean = 0.0;
  constexpr double kStep = 0.01;
  for (double x = 0.5 * kStep; x < 4000.0; x += kStep) {
    mean += kStep * (1.0 - student_t_probability(x, 3, 4));
  }
  EXPECT_NEAR(mean, 3.0, 0.01);
}

TEST(StudentT, IsAGaussianWithManyDegrees) {
  EXPECT_NEAR(student_t_quantile(0.95, 3, 20000), chi_square_quantile(0.95, 3), 5e-3);
  EXPECT_LT(student_t_quantile(0.68, 3, 4), chi_square_quantile(0.68, 3));
}

}  // namespace
}  // namespace sketchloc

#include "motion/graph/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sketchloc {
namespace {

class KernelLaws : public ::testing::TestWithParam<KernelShape> {
 protected:
  const RobustKernel kernel_{.shape = GetParam(), .width = 2.0};
};

INSTANTIATE_TEST_SUITE_P(Shapes, KernelLaws,
                         ::testing::Values(KernelShape::None, KernelShape::Huber,
                                           KernelShape::Cauchy, KernelShape::Dcs,
                                           KernelShape::Graduated));

TEST_P(KernelLaws, TheWeightIsTheSlopeOfTheCost) {
  for (const double chi2 : {1e-3, 1.0, 3.9, 4.1, 17.0, 1e4}) {
    const double step = 1e-6 * chi2;
    const double slope =
        (robust_cost(kernel_, chi2 + step) - robust_cost(kernel_, chi2 - step)) / (2.0 * step);
    EXPECT_NEAR(robust_weight(kernel_, chi2), slope, 1e-6) << chi2;
  }
}

TEST_P(KernelLaws, SmallErrorsCostTheirSquares) {
  EXPECT_EQ(robust_cost(kernel_, 0.0), 0.0);
  EXPECT_EQ(robust_weight(kernel_, 0.0), 1.0);
  EXPECT_NEAR(robust_cost(kernel_, 1e-4) / 1e-4, 1.0, 1e-4);
}

TEST_P(KernelLaws, NoErrorCostsMoreThanItsSquareOrLessThanASmallerOne) {
  double before = 0.0;
  for (double chi2 = 0.1; chi2 < 1e3; chi2 *= 1.3) {
    const double cost = robust_cost(kernel_, chi2);
    EXPECT_LE(cost, chi2 * (1.0 + 1e-12));
    EXPECT_GE(cost, before);
    before = cost;
  }
}

TEST(Kernel, HasTheValuesOfTheTextbook) {
  EXPECT_DOUBLE_EQ(robust_cost({.shape = KernelShape::Huber, .width = 2.0}, 25.0), 16.0);
  EXPECT_DOUBLE_EQ(robust_cost({.shape = KernelShape::Cauchy, .width = 2.0}, 4.0),
                   4.0 * std::log(2.0));
  EXPECT_DOUBLE_EQ(robust_weight({.shape = KernelShape::Dcs, .width = 2.0}, 12.0), 0.25);
  EXPECT_DOUBLE_EQ(robust_cost({.shape = KernelShape::Dcs, .width = 2.0}, 12.0), 8.0);
  EXPECT_DOUBLE_EQ(robust_cost({.shape = KernelShape::Graduated, .width = 2.0}, 12.0), 4.0);
}

TEST(Kernel, RefusesAWidthOfZero) {
  EXPECT_THROW(validate(RobustKernel{.shape = KernelShape::Dcs, .width = 0.0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

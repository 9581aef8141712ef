#include "motion/detail/complex_plane.hpp"

#include <gtest/gtest.h>

namespace sketchloc::detail {
namespace {

/// (e^w - 1) / w by its power series in long double, exact for |w| <= 1.
std::complex<double> series(const std::complex<double>& w) {
  std::complex<long double> term = 1.0L;
  std::complex<long double> sum = 1.0L;
  for (int n = 2; n < 40; ++n) {
    term *= std::complex<long double>(w) / static_cast<long double>(n);
    sum += term;
  }
  return std::complex<double>(sum);
}

TEST(ExpQuotient, IsExactOnBothSidesOfItsSwitch) {
  for (const double size : {0.0, 1e-300, 1e-12, 1e-3, 0.0099999, 0.01, 0.0100001, 0.1, 1.0}) {
    for (const double direction_rad : {0.0, 0.8, 1.5707963267948966, 3.0, -2.0}) {
      const std::complex<double> w = std::polar(size, direction_rad);
      EXPECT_LT(std::abs(exp_quotient(w) - series(w)), 3e-14) << w;
    }
  }
}

TEST(AngleRad, IsInItsHalfOpenRange) {
  EXPECT_EQ(angle_rad({-1.0, -0.0}), std::numbers::pi);
  EXPECT_EQ(angle_rad({-1.0, 0.0}), std::numbers::pi);
  EXPECT_LT(angle_rad({-1.0, -1e-15}), 0.0);
}

}  // namespace
}  // namespace sketchloc::detail

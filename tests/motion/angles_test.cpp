#include "motion/angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sketchloc {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(WrapRad, LeavesAnglesInRangeAlone) {
  for (const double angle_rad : {0.0, -0.0, 1.0, -3.0, kPi, std::nextafter(-kPi, 0.0)}) {
    EXPECT_EQ(wrap_rad(angle_rad), angle_rad);
  }
}

TEST(WrapRad, WrapsFloatsLikeDoubles) {
  constexpr float kFloatPi = std::numbers::pi_v<float>;
  EXPECT_EQ(wrap_rad(-kFloatPi), kFloatPi);
  for (const float angle_rad : {0.0F, 1.0F, -3.0F, 3.1F, 3.2F, -3.2F, 7.0F, -100.0F}) {
    EXPECT_NEAR(wrap_rad(angle_rad), wrap_rad(static_cast<double>(angle_rad)), 2e-5);
  }
}

TEST(WrapRad, TurnsMinusPiIntoPi) { EXPECT_EQ(wrap_rad(-kPi), kPi); }

TEST(WrapRad, TakesWholeTurnsAway) {
  for (const double angle_rad : {0.0, 1.0, -3.0, 3.1}) {
    for (const int turns : {-1000, -3, -1, 1, 2, 1000}) {
      EXPECT_NEAR(wrap_rad(angle_rad + 2.0 * kPi * turns), angle_rad, 1e-12);
    }
  }
}

TEST(WrapRad, StaysInRangeCloseToItsEnds) {
  for (const double turns : {-3.0, -1.0, 1.0, 3.0, 1001.0}) {
    for (double angle_rad = turns * kPi - 1e-14; angle_rad < turns * kPi + 1e-14;
         angle_rad = std::nextafter(angle_rad, 1e9)) {
      ASSERT_GT(wrap_rad(angle_rad), -kPi) << angle_rad;
      ASSERT_LE(wrap_rad(angle_rad), kPi) << angle_rad;
    }
  }
}

TEST(WrapRad, PassesNanOn) {
  EXPECT_TRUE(std::isnan(wrap_rad(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(wrap_rad(std::numeric_limits<double>::infinity())));
}

TEST(Degrees, AreTheSameAngle) {
  EXPECT_DOUBLE_EQ(rad_from_deg(180.0), kPi);
  EXPECT_DOUBLE_EQ(deg_from_rad(-kPi / 2.0), -90.0);
  EXPECT_DOUBLE_EQ(deg_from_rad(rad_from_deg(33.0)), 33.0);
}

}  // namespace
}  // namespace sketchloc

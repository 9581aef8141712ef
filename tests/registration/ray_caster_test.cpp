#include "registration/ray_caster.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/grid_traversal.hpp"
#include "tests/support/grids.hpp"
#include "tests/support/vector_targets.hpp"

namespace sketchloc {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

std::vector<float> fan(std::size_t beams, float first_rad) {
  std::vector<float> headings(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    headings[i] = first_rad + 2.0F * kPi * static_cast<float>(i) / static_cast<float>(beams);
  }
  return headings;
}

/// The oracle's range, or that of a ray a hair's breadth to the side: a float ray that grazes a
/// corner may pass it on either side.
bool agrees(const Grid<std::uint8_t>& occupied, const Eigen::Vector2d& origin, float heading_rad,
            float max_range, float range) {
  const Eigen::Vector2d aside(-std::sin(heading_rad), std::cos(heading_rad));
  for (const double shift : {0.0, -2e-4, 2e-4, -1e-3, 1e-3}) {
    const double expected =
        testing::traverse(occupied, origin + shift * aside, heading_rad, max_range);
    if (std::abs(expected - range) < 2e-3) {
      return true;
    }
  }
  return false;
}

TEST(RayCaster, MeasuresToTheBoundaryOfTheFirstOccupiedCell) {
  Grid<std::uint8_t> occupied(20, 10);
  occupied.at({15, 4}) = 1;
  const RayCaster caster(occupied);
  EXPECT_FLOAT_EQ(caster.range({2.5, 4.5}, 0.0F, 100.0F), 12.5F);
  EXPECT_FLOAT_EQ(caster.range({15.25, 0.5}, kPi / 2, 100.0F), 3.5F);
  EXPECT_FLOAT_EQ(caster.range({18.5, 4.5}, kPi, 100.0F), 2.5F);
  EXPECT_FLOAT_EQ(caster.range({13.5, 2.5}, kPi / 4, 100.0F), std::numbers::sqrt2_v<float> * 1.5F);
  EXPECT_EQ(caster.range({15.5, 4.5}, 1.0F, 100.0F), 0.0F);
}

TEST(RayCaster, GivesTheMaximumWhereNothingIsHit) {
  Grid<std::uint8_t> occupied(20, 10);
  occupied.at({15, 4}) = 1;
  const RayCaster caster(occupied);
  EXPECT_EQ(caster.range({2.5, 4.5}, 0.0F, 12.0F), 12.0F);
  EXPECT_EQ(caster.range({2.5, 4.5}, 2.0F, 100.0F), 100.0F);
  EXPECT_EQ(RayCaster(Grid<std::uint8_t>()).range({0.0, 0.0}, 0.0F, 7.0F), 7.0F);
}

TEST(RayCaster, SeesIntoTheGridFromOutside) {
  Grid<std::uint8_t> occupied(20, 10);
  occupied.at({15, 4}) = 1;
  const RayCaster caster(occupied);
  EXPECT_FLOAT_EQ(caster.range({-5.0, 4.5}, 0.0F, 100.0F), 20.0F);
  EXPECT_FLOAT_EQ(caster.range({15.5, 30.0}, -kPi / 2, 100.0F), 25.0F);
  EXPECT_EQ(caster.range({-5.0, 4.5}, kPi, 100.0F), 100.0F);
  EXPECT_EQ(caster.range({-5.0, -4.0}, 0.0F, 100.0F), 100.0F);
}

TEST(RayCaster, NeverSlipsBetweenTwoCellsThatTouchAtACorner) {
  Grid<std::uint8_t> occupied(64, 64);
  for (int i = 0; i < 64; ++i) {
    occupied.at({i, 63 - i}) = 1;
  }
  const RayCaster caster(occupied);
  const std::vector<float> headings = fan(4096, 0.0F);
  std::vector<float> ranges(headings.size());
  caster.cast({10.5, 20.5}, headings, 1000.0F, ranges);
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const float x = 10.5F + ranges[i] * std::cos(headings[i]);
    const float y = 20.5F + ranges[i] * std::sin(headings[i]);
    ASSERT_TRUE(x + y < 64.1F || x < 0.0F || y < 0.0F) << headings[i];
  }
}

class RayCasterOn : public ::testing::TestWithParam<int> {
 protected:
  static Grid<std::uint8_t> grid() {
    switch (GetParam()) {
      case 0:
        return testing::rooms(400, 400, 57, 12);
      case 1:
        return testing::rooms(130, 77, 19, 5);
      case 2:
        return testing::thin_strokes(200, 300, 60, 1);
      default:
        return testing::thin_strokes(1100, 40, 5, 2);
    }
  }
};

TEST_P(RayCasterOn, AgreesWithTheTraversalCellByCell) {
  const Grid<std::uint8_t> occupied = grid();
  const RayCaster caster(occupied);
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> x(0.0, occupied.width());
  std::uniform_real_distribution<double> y(0.0, occupied.height());
  std::vector<float> ranges(181);
  for (int scan = 0; scan < 200; ++scan) {
    // Floats, so that oracle and caster start from the same point.
    const Eigen::Vector2d origin(static_cast<float>(x(engine)), static_cast<float>(y(engine)));
    const std::vector<float> headings = fan(181, 0.01F * static_cast<float>(scan));
    caster.cast(origin, headings, 500.0F, ranges);
    for (std::size_t i = 0; i < headings.size(); ++i) {
      ASSERT_TRUE(agrees(occupied, origin, headings[i], 500.0F, ranges[i]))
          << "from " << origin.transpose() << " heading " << headings[i] << ": " << ranges[i]
          << " instead of " << testing::traverse(occupied, origin, headings[i], 500.0);
    }
  }
}

TEST_P(RayCasterOn, GivesTheSameBitsWithEveryInstructionSet) {
  const RayCaster caster(grid());
  const Eigen::Vector2d origin(37.3, 21.9);
  const std::vector<float> headings = fan(1001, 0.1F);
  std::vector<float> ranges(headings.size());
  caster.cast(origin, headings, 300.0F, ranges);
  for (const std::int64_t target : testing::vector_targets()) {
    const testing::OnlyTarget only(target);
    std::vector<float> other(headings.size());
    caster.cast(origin, headings, 300.0F, other);
    EXPECT_EQ(ranges, other) << hwy::TargetName(target);
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, RayCasterOn, ::testing::Range(0, 4));

}  // namespace
}  // namespace sketchloc

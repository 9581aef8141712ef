#include "registration/range_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/grid_traversal.hpp"
#include "tests/support/grids.hpp"
#include "tests/support/vector_targets.hpp"

namespace sketchloc {
namespace {

constexpr double kNothingPx = 1e9;

double heading_of(int heading) {
  return heading * (2.0 * std::numbers::pi / RangeTable::kHeadings);
}

double table_range(const RangeTable& table, const Cell& cell, int heading) {
  const Eigen::Vector2d point = centre_of(cell) * table.cell_px();
  return table.range_px(point, heading_of(heading)).value_or(kNothingPx);
}

/// Headings of [-45, 45) deg and [135, 225) deg.
bool runs_along_x(int heading) { return (heading + 16) % 64 < 32; }

struct Interval {
  double low = kNothingPx;
  double high = 0.0;
};

/// The ranges from all starts that the table allows itself: up to 1/8 px from the pixel's centre,
/// across the heading's axis.
Interval oracle(const Grid<std::uint8_t>& occupied, const Eigen::Vector2d& centre, int heading) {
  const Eigen::Vector2d aside =
      runs_along_x(heading) ? Eigen::Vector2d(0.0, 1.0) : Eigen::Vector2d(1.0, 0.0);
  Interval range;
  for (int i = -130; i <= 130; ++i) {
    const double at = testing::traverse_beyond_own_stroke(occupied, centre + i * 1e-3 * aside,
                                                          heading_of(heading), kNothingPx);
    range.low = std::min(range.low, at);
    range.high = std::max(range.high, at);
  }
  return range;
}

Grid<std::uint8_t> drawing(int kind) {
  switch (kind) {
    case 0:
      return testing::rooms(230, 170, 57, 12);
    case 1:
      return testing::thin_strokes(90, 130, 25, 1);
    case 2:
      return testing::thin_strokes(500, 33, 5, 2);
    default:
      return testing::thin_strokes(31, 17, 5, 3);
  }
}

class RangeTableOf : public ::testing::TestWithParam<int> {};

TEST_P(RangeTableOf, HoldsTheExactRangeFromWithinAnEighthOfThePixelsCentre) {
  const Grid<std::uint8_t> occupied = drawing(GetParam());
  const RangeTable table(occupied);
  ASSERT_EQ(table.cell_px(), 1);
  std::mt19937_64 engine(11);
  std::uniform_int_distribution<int> column(0, occupied.width() - 1);
  std::uniform_int_distribution<int> row(0, occupied.height() - 1);
  const double rounding = std::exp(0.5 * table.params().log_step);
  for (int i = 0; i < 8 * RangeTable::kHeadings; ++i) {
    const Cell cell{column(engine), row(engine)};
    const int heading = i % RangeTable::kHeadings;
    const double range = table_range(table, cell, heading);
    const Interval exact = oracle(occupied, centre_of(cell), heading);
    // 1/16 px: the sub-pixel unit of the sweep, seen under the steepest heading.
    ASSERT_GE(range, std::max(0.5, exact.low - 0.0625) / rounding)
        << "column " << cell.column << " row " << cell.row << " heading " << heading;
    ASSERT_LE(range, std::max(0.5, exact.high + 0.0625) * rounding)
        << "column " << cell.column << " row " << cell.row << " heading " << heading;
  }
}

TEST_P(RangeTableOf, IsTheSameBytesWithEveryInstructionSet) {
  const Grid<std::uint8_t> occupied = drawing(GetParam());
  const RangeTable table(occupied);
  for (const std::int64_t target : testing::vector_targets()) {
    const testing::OnlyTarget only(target);
    const RangeTable other(occupied);
    EXPECT_TRUE(std::ranges::equal(table.codes(), other.codes())) << hwy::TargetName(target);
  }
}

INSTANTIATE_TEST_SUITE_P(Drawings, RangeTableOf, ::testing::Range(0, 4));

TEST(RangeTable, SeesBothSidesOfTheStrokeItStandsOn) {
  Grid<std::uint8_t> occupied(100, 30);
  for (int row = 0; row < 30; ++row) {
    for (const int column : {20, 50, 51, 80}) {
      occupied.at({column, row}) = 1;
    }
  }
  const RangeTable table(occupied);
  EXPECT_NEAR(table_range(table, {50, 15}, 0), 29.5, 0.5);
  EXPECT_NEAR(table_range(table, {50, 15}, 64), 29.5, 0.5);
  EXPECT_NEAR(table_range(table, {49, 15}, 0), 0.5, 0.05);
  EXPECT_EQ(table_range(table, {50, 15}, 32), kNothingPx);  // along the stroke, out of the drawing
}

TEST(RangeTable, NeverLetsALookThroughALineThatIsConnectedOverCornersOnly) {
  Grid<std::uint8_t> occupied(120, 120);
  for (int i = 0; i < 120; ++i) {
    occupied.at({i, 119 - i}) = 1;
  }
  const RangeTable table(occupied);
  for (int heading = 0; heading < RangeTable::kHeadings; ++heading) {
    const double x = std::cos(heading_of(heading));
    const double y = std::sin(heading_of(heading));
    for (int i = 0; i < 100; ++i) {
      const Cell below{10 + (i * 7) % 40, 10 + (i * 13) % 45};
      const double range = table_range(table, below, heading);
      const Eigen::Vector2d end = centre_of(below) + range * Eigen::Vector2d(x, y);
      ASSERT_TRUE(end.sum() < 124.0 || end.minCoeff() < 0.0) << "heading " << heading;
    }
  }
}

TEST(RangeTable, TakesCoarserCellsWhenTheDrawingIsLarge) {
  const Grid<std::uint8_t> occupied = testing::rooms(230, 170, 57, 12);
  const RangeTable table(occupied, {.memory_mb = 0.6});
  EXPECT_EQ(table.cell_px(), 3);
  EXPECT_EQ(table.columns(), 77);
  EXPECT_EQ(table.rows(), 57);
  EXPECT_LE(table.codes().size(), 600000U);
  for (int i = 0; i < 1000; ++i) {
    const Cell cell{(i * 31) % 76, (i * 17) % 56};
    const int heading = i % RangeTable::kHeadings;
    const Interval exact = oracle(occupied, {cell.column * 3 + 1.5, cell.row * 3 + 1.5}, heading);
    const double range = table_range(table, cell, heading);
    ASSERT_GE(range, (exact.low - 0.0625) * std::exp(-0.015));
    ASSERT_LE(range, (exact.high + 0.0625) * std::exp(0.015));
  }
}

TEST(RangeTable, KnowsNothingOutsideTheDrawingAndBeyondItsCodes) {
  Grid<std::uint8_t> occupied(600, 4);
  occupied.at({599, 2}) = 1;
  const RangeTable table(occupied, {.min_range_px = 0.5, .log_step = 0.025});
  EXPECT_NEAR(table.max_range_px(), 0.5 * std::exp(0.025 * 254), 1e-9);  // 286 px
  EXPECT_FALSE(table.range_px({100.5, 2.5}, 0.0));
  EXPECT_TRUE(table.range_px({400.5, 2.5}, 0.0));
  EXPECT_FALSE(table.range_px({-1.0, 2.5}, 0.0));
  EXPECT_FALSE(table.range_px({3.0, 4.0}, 0.0));
  EXPECT_TRUE(RangeTable(Grid<std::uint8_t>()).codes().empty());
}

TEST(RangeTable, RefusesParametersOutOfRange) {
  const Grid<std::uint8_t> occupied(3, 3);
  EXPECT_THROW(RangeTable(occupied, {.min_range_px = 0.0}), std::invalid_argument);
  EXPECT_THROW(RangeTable(occupied, {.log_step = 0.5}), std::invalid_argument);
  EXPECT_THROW(RangeTable(occupied, {.log_step = 0.02}), std::invalid_argument);
  EXPECT_THROW(RangeTable(occupied, {.memory_mb = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

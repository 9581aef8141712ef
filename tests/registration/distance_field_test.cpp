#include "registration/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

/// The definition, cell against cell.
Grid<float> brute_force(const Grid<std::uint8_t>& occupied) {
  Grid<float> distances(occupied.width(), occupied.height());
  for (int row = 0; row < occupied.height(); ++row) {
    for (int column = 0; column < occupied.width(); ++column) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int other_row = 0; other_row < occupied.height(); ++other_row) {
        for (int other = 0; other < occupied.width(); ++other) {
          if (occupied.at({other, other_row}) != 0) {
            nearest = std::min(nearest, std::hypot(other - column, other_row - row));
          }
        }
      }
      distances.at({column, row}) = static_cast<float>(nearest);
    }
  }
  return distances;
}

void expect_equal(const Grid<float>& actual, const Grid<float>& expected) {
  ASSERT_EQ(actual.width(), expected.width());
  ASSERT_EQ(actual.height(), expected.height());
  for (int row = 0; row < actual.height(); ++row) {
    for (int column = 0; column < actual.width(); ++column) {
      ASSERT_FLOAT_EQ(actual.at({column, row}), expected.at({column, row}))
          << "column " << column << ", row " << row;
    }
  }
}

TEST(DistanceField, IsTheDistanceToTheNearestOccupiedCell) {
  for (const int strokes : {1, 3, 12}) {
    const Grid<std::uint8_t> thin = testing::thin_strokes(67, 43, strokes, 5);
    expect_equal(distance_field_px(thin), brute_force(thin));
  }
  const Grid<std::uint8_t> building = testing::rooms(60, 80, 23, 6);
  expect_equal(distance_field_px(building), brute_force(building));
}

TEST(DistanceField, HandlesSingleCellsInEveryPlace) {
  for (int place = 0; place < 35; ++place) {
    Grid<std::uint8_t> occupied(7, 5);
    occupied.at({place % 7, place / 7}) = 255;
    occupied.at({(place * 11) % 7, (place * 3) % 5}) = 1;
    expect_equal(distance_field_px(occupied), brute_force(occupied));
  }
}

TEST(DistanceField, HandlesGridsThatAreEmptyFullOrOneCellWide) {
  EXPECT_TRUE(distance_field_px(Grid<std::uint8_t>()).empty());
  expect_equal(distance_field_px(Grid<std::uint8_t>(9, 4)),
               Grid<float>(9, 4, std::numeric_limits<float>::infinity()));
  expect_equal(distance_field_px(Grid<std::uint8_t>(9, 4, 1)), Grid<float>(9, 4, 0.0F));
  Grid<std::uint8_t> column(1, 50);
  column.at({0, 40}) = 1;
  expect_equal(distance_field_px(column), brute_force(column));
  Grid<std::uint8_t> row(50, 1);
  row.at({3, 0}) = 1;
  expect_equal(distance_field_px(row), brute_force(row));
}

}  // namespace
}  // namespace sketchloc

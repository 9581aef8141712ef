#include "datasets/grid.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sketchloc {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Cell (column, row) holds 10 row + column.
Grid<float> ramp(int width, int height) {
  Grid<float> grid(width, height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      grid.at({column, row}) = static_cast<float>(10 * row + column);
    }
  }
  return grid;
}

TEST(Grid, IsEmptyByDefault) {
  const Grid<int> grid;
  EXPECT_TRUE(grid.empty());
  EXPECT_FALSE(grid.contains({0, 0}));
}

TEST(Grid, IsFilledWithOneValue) {
  const Grid<int> grid(3, 2, 7);
  EXPECT_EQ(grid.width(), 3);
  EXPECT_EQ(grid.height(), 2);
  for (const int value : grid.cells()) {
    EXPECT_EQ(value, 7);
  }
}

TEST(Grid, ContainsItsCellsAlone) {
  const Grid<int> grid(3, 2);
  EXPECT_TRUE(grid.contains({0, 0}));
  EXPECT_TRUE(grid.contains({2, 1}));
  for (const Cell cell : {Cell{-1, 0}, Cell{0, -1}, Cell{3, 0}, Cell{0, 2}}) {
    EXPECT_FALSE(grid.contains(cell)) << cell.column << " " << cell.row;
  }
}

TEST(Grid, StoresRowsFromTheBottom) {
  Grid<float> grid = ramp(3, 2);
  EXPECT_EQ(grid.row(1)[2], 12.0f);
  EXPECT_EQ(grid.cells()[3], 10.0f);
  grid.row(0)[1] = -1.0f;
  EXPECT_EQ(grid.at({1, 0}), -1.0f);
}

TEST(Grid, ComparesSizeAndCells) {
  EXPECT_EQ(ramp(3, 2), ramp(3, 2));
  EXPECT_NE(Grid<int>(3, 2), Grid<int>(2, 3));
  EXPECT_NE(Grid<int>(1, 1, 0), Grid<int>(1, 1, 1));
}

TEST(GridDeathTest, RefusesCellsAndRowsOutsideAndNegativeSizes) {
  const Grid<int> grid(3, 2);
  EXPECT_DEATH(grid.at({3, 0}), "cell outside the grid");
  EXPECT_DEATH(grid.row(2), "row outside the grid");
  EXPECT_DEATH(Grid<int>(-1, 2), "no negative size");
}

TEST(CellAt, RoundsDown) {
  EXPECT_EQ(cell_at({0.0, 0.999}), (Cell{0, 0}));
  EXPECT_EQ(cell_at({-0.001, 3.0}), (Cell{-1, 3}));
}

TEST(CellAt, GivesACellOutsideEveryGridForPointsBeyondAllNumbers) {
  const Grid<int> grid(100, 100);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double x : {1e300, -1e300, kInfinity, -kInfinity, static_cast<double>(kNan)}) {
    EXPECT_FALSE(grid.contains(cell_at({x, 5.0}))) << x;
    EXPECT_FALSE(grid.contains(cell_at({5.0, x}))) << x;
  }
}

TEST(CentreOf, LiesInItsCell) {
  EXPECT_EQ(centre_of({2, -1}), Eigen::Vector2d(2.5, -0.5));
  EXPECT_EQ(cell_at(centre_of({2, -1})), (Cell{2, -1}));
}

TEST(Sample, GivesTheCellsOwnValueAtItsCentre) {
  const Grid<float> grid = ramp(4, 3);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(sample(grid, centre_of({column, row})), grid.at({column, row}));
    }
  }
}

TEST(Sample, IsBilinearBetweenCentres) {
  const Grid<float> grid = ramp(4, 3);  // linear itself: x - 0.5 + 10 (y - 0.5)
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(3.25, 0.75), Eigen::Vector2d(0.6, 2.4)}) {
    const double expected = point.x() - 0.5 + 10.0 * (point.y() - 0.5);
    EXPECT_NEAR(sample(grid, point).value(), expected, 1e-5);
  }
}

TEST(Sample, GivesNothingOutsideTheOutermostCentres) {
  const Grid<float> grid = ramp(4, 3);
  EXPECT_TRUE(sample(grid, {3.5, 2.5}).has_value());
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(0.49, 1.0), Eigen::Vector2d(3.51, 1.0), Eigen::Vector2d(1.0, 0.49),
        Eigen::Vector2d(1.0, 2.51), Eigen::Vector2d(kNan, 1.0), Eigen::Vector2d(1.0, 1e300)}) {
    EXPECT_FALSE(sample(grid, point).has_value()) << point.transpose();
  }
  EXPECT_FALSE(sample(Grid<float>(), {0.5, 0.5}).has_value());
}

TEST(Sample, WorksOnGridsOfOneCellOneRowOrOneColumn) {
  EXPECT_EQ(sample(Grid<float>(1, 1, 5.0f), {0.5, 0.5}), 5.0f);
  EXPECT_EQ(sample(ramp(3, 1), {1.0, 0.5}), 0.5f);
  EXPECT_EQ(sample(ramp(1, 3), {0.5, 2.0}), 15.0f);
}

}  // namespace
}  // namespace sketchloc

#include "datasets/sim/raster.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace sketchloc {
namespace {

int painted(const Grid<std::uint8_t>& cells) {
  return std::accumulate(cells.cells().begin(), cells.cells().end(), 0);
}

TEST(PaintLine, CoversTheCellsUnderARoundPen) {
  Grid<std::uint8_t> cells(20, 20);
  paint_line(cells, {5.0, 10.0}, {15.0, 10.0}, 4.0);
  EXPECT_EQ(cells.at({10, 8}), 1);
  EXPECT_EQ(cells.at({10, 11}), 1);
  EXPECT_EQ(cells.at({10, 7}), 0);
  EXPECT_EQ(cells.at({10, 12}), 0);
  EXPECT_EQ(cells.at({17, 10}), 0);
  EXPECT_EQ(cells.at({16, 10}), 1);  // the round end
}

TEST(PaintLine, HasNoHolesHoweverThin) {
  Grid<std::uint8_t> cells(50, 50);
  paint_line(cells, {1.2, 3.7}, {48.1, 31.3}, 0.0);
  for (int column = 2; column < 48; ++column) {
    bool any = false;
    for (int row = 0; row < 50; ++row) {
      any = any || cells.at({column, row}) != 0;
    }
    EXPECT_TRUE(any) << column;
  }
}

TEST(PaintLine, ClipsWhatLiesOutside) {
  Grid<std::uint8_t> cells(5, 5);
  paint_line(cells, {-100.0, 2.5}, {100.0, 2.5}, 1.0);
  EXPECT_EQ(painted(cells), 5);
  paint_line(cells, {-100.0, -50.0}, {-10.0, 100.0}, 3.0);
  EXPECT_EQ(painted(cells), 5);
}

TEST(PaintPolyline, PaintsEveryPieceAndNothingWithoutPoints) {
  Grid<std::uint8_t> cells(10, 10);
  paint_polyline(cells, {}, 1.0);
  EXPECT_EQ(painted(cells), 0);
  paint_polyline(cells, std::vector<Eigen::Vector2d>{{0.5, 0.5}, {9.5, 0.5}, {9.5, 9.5}}, 0.0);
  EXPECT_EQ(painted(cells), 19);
}

TEST(PaintConvex, FillsTheInside) {
  Grid<std::uint8_t> cells(10, 10);
  paint_convex(cells, std::vector<Eigen::Vector2d>{{2.0, 2.0}, {7.0, 2.0}, {7.0, 6.0}, {2.0, 6.0}});
  EXPECT_EQ(painted(cells), 20);
  EXPECT_EQ(cells.at({2, 2}), 1);
  EXPECT_EQ(cells.at({7, 2}), 0);
}

TEST(PaintConvex, LeavesTheGridAloneWithoutCorners) {
  Grid<std::uint8_t> cells(3, 3);
  paint_convex(cells, {});
  EXPECT_EQ(painted(cells), 0);
}

}  // namespace
}  // namespace sketchloc

#include "datasets/sim/detail/wall_tracing.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "datasets/sim/raster.hpp"

namespace sketchloc::detail {
namespace {

int painted(const Grid<std::uint8_t>& cells) {
  return std::accumulate(cells.cells().begin(), cells.cells().end(), 0);
}

TEST(Thin, LeavesTheMiddleOfABar) {
  Grid<std::uint8_t> bar(40, 20);
  paint_line(bar, {5.0, 10.5}, {35.0, 10.5}, 5.0);
  const Grid<std::uint8_t> thinned = thin(bar);
  EXPECT_LT(painted(thinned), 40);
  for (int column = 8; column < 32; ++column) {
    EXPECT_EQ(thinned.at({column, 10}), 1) << column;
  }
}

TEST(Thin, KeepsARingARing) {
  Grid<std::uint8_t> ring(40, 40);
  const Polyline square = {{8.0, 8.0}, {32.0, 8.0}, {32.0, 32.0}, {8.0, 32.0}, {8.0, 8.0}};
  paint_polyline(ring, square, 5.0);
  const std::vector<Polyline> lines = trace_lines(thin(ring));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_NEAR(length(lines[0]), 4.0 * 24.0, 6.0);
}

TEST(TraceLines, CutsWhereLinesMeet) {
  Grid<std::uint8_t> cross(21, 21);
  paint_line(cross, {0.5, 10.5}, {20.5, 10.5}, 0.0);
  paint_line(cross, {10.5, 0.5}, {10.5, 20.5}, 0.0);
  const std::vector<Polyline> lines = trace_lines(cross);
  double total = 0.0;
  for (const Polyline& line : lines) {
    total += length(line);
  }
  EXPECT_GE(lines.size(), 4U);
  EXPECT_NEAR(total, 40.0, 4.0);
}

TEST(TraceLines, FindsNothingInNothing) {
  EXPECT_TRUE(trace_lines(Grid<std::uint8_t>(10, 10)).empty());
  EXPECT_TRUE(trace_lines(Grid<std::uint8_t>()).empty());
}

TEST(Simplify, KeepsCornersAndDropsTheRest) {
  const Polyline corner = resample(Polyline{{0.0, 0.0}, {10.0, 0.0}, {10.0, 5.0}}, 0.5);
  const Polyline simple = simplify(corner, 0.1);
  ASSERT_EQ(simple.size(), 3U);
  EXPECT_EQ(simple[1], Eigen::Vector2d(10.0, 0.0));
}

TEST(Simplify, KeepsALoopOpenWide) {
  const Polyline square = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}, {0.0, 0.0}};
  EXPECT_EQ(simplify(resample(square, 0.5), 0.1).size(), 5U);
}

}  // namespace
}  // namespace sketchloc::detail

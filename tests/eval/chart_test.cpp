#include "eval/detail/chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/markup.hpp"

namespace sketchloc::detail {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(RoundTicks, AreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_THAT(round_ticks(0.0, 8.0, 5), ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0));
  EXPECT_THAT(round_ticks(-1.3, 0.2, 3), ElementsAre(-1.0, -0.5, 0.0));
  EXPECT_THAT(round_ticks(0.0, 0.031, 3),
              ElementsAre(DoubleNear(0.0, 1e-12), DoubleNear(0.02, 1e-12)));
}

TEST(RoundTicks, OfNoRangeAreOneTick) { EXPECT_THAT(round_ticks(4.0, 4.0, 5), ElementsAre(4.0)); }

Chart chart_of(const Polyline& points) {
  Chart chart{.title = "Error <&>", .unit = "m", .x_high = 10.0, .x_unit = "s"};
  chart.curves = {{.name = "error", .colour = kBad, .points = points}};
  return chart;
}

TEST(Chart, BreaksItsCurveWhereAValueIsMissing) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::string html = chart_html(chart_of({{0, 0}, {2, 1}, {4, none}, {6, 0}, {10, 1}}));
  EXPECT_THAT(html, HasSubstr("M0 1000L200 0M600 1000L1000 0"));
}

TEST(Chart, IsWellFormedAndEscaped) {
  const std::string html = chart_html(chart_of({{0, 0}, {10, 1}}));
  EXPECT_THAT(testing::markup_faults(html), IsEmpty());
  EXPECT_THAT(html, Not(HasSubstr("<&>")));
}

TEST(Chart, OfALongRunStaysSmallButKeepsItsPeaks) {
  Polyline points;
  for (int i = 0; i < 100000; ++i) {
    points.emplace_back(1e-4 * i, i == 70001 ? 1.0 : 0.0);
  }
  const std::string html = chart_html(chart_of(points));
  EXPECT_LT(html.size(), 30000U);
  EXPECT_THAT(html, HasSubstr(" 0L"));  // y = 0 is the upper edge: the peak
}

TEST(FitYRange, HoldsAllCurvesAndSurvivesNone) {
  Chart chart = chart_of({{0, 3}, {1, 4}});
  fit_y_range(chart);
  EXPECT_LE(chart.y_low, 3.0);
  EXPECT_GE(chart.y_high, 4.0);
  Chart empty = chart_of({});
  fit_y_range(empty);
  EXPECT_LT(empty.y_low, empty.y_high);
  Chart flat = chart_of({{0, 5}, {1, 5}});
  fit_y_range(flat);
  EXPECT_LT(flat.y_low, flat.y_high);
}

}  // namespace
}  // namespace sketchloc::detail

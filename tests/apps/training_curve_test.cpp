#include "apps/training_curve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string three_rows() {
  std::string csv = curve_header();
  for (const std::uint64_t samples : {1000U, 2000U, 3000U}) {
    csv += curve_row({.samples = samples,
                      .seconds = 0.5 * static_cast<double>(samples),
                      .loss = {.total = 1.25},
                      .validation = {}});
  }
  return csv;
}

TEST(TrainingCurve, HasAColumnForEveryNumber) {
  const std::string header = curve_header();
  const std::string row = curve_row({});
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(row.begin(), row.end(), ','));
  EXPECT_THAT(curve_row({.samples = 128, .seconds = 2.5, .loss = {}, .validation = {}}),
              StartsWith("128,2.5,"));
}

TEST(TrainingCurve, ForgetsWhatCameAfterACheckpoint) {
  const std::string kept = curve_until(three_rows(), 2000);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), '\n'), 3);
  EXPECT_EQ(seconds_of_curve(kept), 1000.0);
  EXPECT_EQ(curve_until(kept, 2000), kept);
}

TEST(TrainingCurve, BeginsWithItsHeaderAlone) {
  EXPECT_EQ(curve_until("", 2000), curve_header());
  EXPECT_EQ(seconds_of_curve(curve_header()), 0.0);
}

TEST(TrainingCurve, IsAPictureFromTwoPointsOn) {
  EXPECT_EQ(curve_svg(curve_header()), "");
  const auto point = [](std::uint64_t samples, double error_m) {
    ValidationReport report;
    report.position_m.median = error_m;
    report.prior_position_m.median = 1.0;
    report.prior_heading_rad.median = 0.1;
    return curve_row({.samples = samples, .seconds = 1.0, .loss = {}, .validation = report});
  };
  const std::string svg =
      curve_svg(curve_header() + point(1'000'000, 0.5) + point(2'000'000, 0.25));
  EXPECT_THAT(svg, HasSubstr("last 25.0"));
  EXPECT_THAT(svg, HasSubstr("2.0M"));
}

TEST(TrainingCurve, RefusesARowThatIsNone) {
  EXPECT_THROW(curve_until(curve_header() + "spilt coffee\n", 10), std::runtime_error);
}

}  // namespace
}  // namespace sketchloc

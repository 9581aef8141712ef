#include "apps/training_curve.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::array<std::string_view, 2> kColumns = {"error_cm", "prior_error_cm"};
constexpr std::array kPanels = {
    CurvePanel{
        .title = "Error", .column = "error_cm", .top_column = "prior_error_cm", .unit = "cm"},
    CurvePanel{.title = "Share", .column = "error_cm", .unit = "%"}};

std::string header() { return curve_header(kColumns); }

std::string row(std::uint64_t samples, double error_cm) {
  return curve_row(samples, 0.5 * static_cast<double>(samples), std::array{error_cm, 100.0});
}

TEST(TrainingCurve, IsATable) {
  EXPECT_EQ(header() + row(128, 2.5), "samples,seconds,error_cm,prior_error_cm\n128,64,2.5,100\n");
}

TEST(TrainingCurve, ForgetsWhatCameAfterACheckpoint) {
  const std::string kept =
      curve_until(header() + row(1000, 3) + row(2000, 2) + row(3000, 1), header(), 2000);
  EXPECT_EQ(kept, header() + row(1000, 3) + row(2000, 2));
  EXPECT_EQ(seconds_of_curve(kept), 1000.0);
  EXPECT_EQ(curve_until(kept, header(), 2000), kept);
}

TEST(TrainingCurve, BeginsWithItsHeaderAlone) {
  EXPECT_EQ(curve_until("", header(), 2000), header());
  EXPECT_EQ(seconds_of_curve(header()), 0.0);
}

TEST(TrainingCurve, IsAPictureFromTwoPointsOn) {
  EXPECT_EQ(curve_svg(header() + row(1, 1), kPanels), "");
  const std::string svg = curve_svg(header() + row(1'000'000, 50) + row(2'000'000, 25), kPanels);
  EXPECT_THAT(svg, HasSubstr("Error, cm (top: the priors); last 25.0"));
  EXPECT_THAT(svg, HasSubstr("Share, %; last 25.0"));
  EXPECT_THAT(svg, HasSubstr("2.0M"));
}

TEST(TrainingCurve, RefusesARowThatIsNone) {
  EXPECT_THROW(curve_until(header() + "spilt coffee\n", header(), 10), std::runtime_error);
}

}  // namespace
}  // namespace sketchloc

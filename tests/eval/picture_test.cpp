#include "eval/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "eval/detail/raster.hpp"
#include "eval/detail/run_picture.hpp"
#include "tests/eval/synthetic_run.hpp"

namespace sketchloc {
namespace {

using testing::make_synthetic_run;
using testing::Outcome;

cv::Mat3b decoded(const std::string& png) {
  return cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_COLOR);
}

int count_of(const cv::Mat3b& image, const detail::Colour& colour) {
  const cv::Vec3b wanted(colour.blue, colour.green, colour.red);
  return static_cast<int>(std::count(image.begin(), image.end(), wanted));
}

TEST(Picture, ShowsTheReferenceAndTheEstimateByItsError) {
  const cv::Mat3b image = decoded(picture_png(make_synthetic_run(Outcome::Lost)));
  EXPECT_EQ(std::max(image.cols, image.rows), 1600);
  EXPECT_GT(count_of(image, detail::kReferenceBlue), 1000);
  EXPECT_GT(count_of(image, detail::kGood), 1000);
  EXPECT_GT(count_of(image, detail::kBad), 1000);
}

TEST(Picture, OfAGoodRunHasNothingInTheColourOfErrors) {
  const cv::Mat3b image = decoded(picture_png(make_synthetic_run(Outcome::Located)));
  EXPECT_EQ(count_of(image, detail::kBad), 0);
}

TEST(Picture, OfAnEmptyRunIsStillAPicture) {
  EXPECT_FALSE(decoded(picture_png(RunRecord{})).empty());
}

TEST(Picture, OfAnEstimateFarOffTheSheetKeepsToTheDrawing) {
  RunRecord record = make_synthetic_run(Outcome::Located);
  for (const double far_px : {1e5, 1e9, 1e15}) {
    StepReport& last = record.steps.back();
    last.estimate.sketch_from_robot = Sim2::from_xy_yaw_scale(far_px, -far_px, 0.0, 20.0);
    const auto layers = detail::path_layers(record, step_errors(record));
    const detail::View view = detail::whole_view(record, layers);
    EXPECT_LT(view.width(), 2.2 * std::max(record.sketch.width_px(), record.sketch.height_px()));
    EXPECT_GT(count_of(decoded(picture_png(record)), detail::kGood), 1000);
  }
}

TEST(RunPicture, CutsThePathWhereTheEstimateJumps) {
  const RunRecord record = make_synthetic_run(Outcome::Recovered);
  const auto layers = detail::path_layers(record, step_errors(record));
  EXPECT_EQ(layers.back().name, "jump of the estimate");
  EXPECT_EQ(layers.back().lines.size(), 1U);
}

TEST(RunPicture, HoldsAllStrokesAndPaths) {
  const RunRecord record = make_synthetic_run(Outcome::Lost);
  const auto layers = detail::path_layers(record, step_errors(record));
  const detail::View view = detail::whole_view(record, layers);
  for (const detail::PathLayer& layer : layers) {
    for (const detail::Polyline& line : layer.lines) {
      for (const Eigen::Vector2d& point : line) {
        EXPECT_TRUE((point.array() > view.low.array()).all() &&
                    (point.array() < view.high.array()).all());
      }
    }
  }
}

TEST(Raster, KeepsThinLinesWhenReduced) {
  Grid<std::uint8_t> grey(400, 400, 255);
  for (int row = 0; row < 400; ++row) {
    grey.at({200, row}) = 125;
  }
  const detail::View whole{.low = {0.0, 0.0}, .high = {400.0, 400.0}};
  const Grid<std::uint8_t> small = detail::zoomed(grey, whole, 0.25);
  ASSERT_EQ(small.width(), 100);
  EXPECT_LT(small.at({50, 50}), 140);
  EXPECT_GT(small.at({20, 50}), 250);
}

TEST(Raster, IsWhiteBeyondTheEdgeAndTheRightWayUp) {
  Grid<std::uint8_t> grey(4, 2, 100);
  grey.at({0, 1}) = 50;  // upper left
  const detail::View wider{.low = {-2.0, -2.0}, .high = {6.0, 4.0}};
  const Grid<std::uint8_t> wide = detail::zoomed(grey, wider, 1.0);
  EXPECT_EQ(wide.at({0, 0}), 255);
  EXPECT_EQ(wide.at({2, 2}), 100);
  EXPECT_EQ(wide.at({2, 3}), 50);
}

}  // namespace
}  // namespace sketchloc

#include "registration/sketch_crop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "motion/angles.hpp"
#include "registration/scan_raster.hpp"
#include "tests/support/simulated_scan.hpp"

namespace sketchloc {
namespace {

constexpr double kPxPerM = 20.0;
const LocalWindow kWindow{.side_m = 12.0, .cells = 48};  // cells of 0.25 m or 5 px

/// A room of 9 m x 7 m with a block in it and walls one px wide, 20 px/m.
Grid<std::uint8_t> room() {
  Grid<std::uint8_t> occupied(200, 160);
  for (int x = 10; x <= 190; ++x) {
    occupied.at({x, 10}) = 1;
    occupied.at({x, 150}) = 1;
  }
  for (int y = 10; y <= 150; ++y) {
    occupied.at({10, y}) = 1;
    occupied.at({190, y}) = 1;
  }
  for (int x = 120; x < 150; ++x) {
    for (int y = 60; y < 80; ++y) {
      occupied.at({x, y}) = 1;
    }
  }
  return occupied;
}

double agreement(const Grid<float>& scan, const Grid<float>& crop, const Cell& shift) {
  double sum = 0.0;
  for (int row = 1; row + 1 < scan.height(); ++row) {
    for (int column = 1; column + 1 < scan.width(); ++column) {
      sum += static_cast<double>(scan.at({column, row})) *
             static_cast<double>(crop.at({column + shift.column, row + shift.row}));
    }
  }
  return sum;
}

/// Where the parabola through three values at -1, 0 and 1 is highest.
double peak(double before, double here, double after) {
  return 0.5 * (before - after) / (before - 2.0 * here + after);
}

class SketchCropOverlay : public ::testing::TestWithParam<Sim2> {};

TEST_P(SketchCropOverlay, LaysAScanOverAnUndeformedDrawingToAFractionOfACell) {
  const Grid<std::uint8_t> occupied = room();
  const Scan scan = testing::simulated_scan(occupied, GetParam(), 360);
  const std::vector<PlacedScan> scans = {{.scan = &scan}};
  const ScanRaster raster = raster_scans(scans, kWindow);
  const SketchCrop crop = SketchCropper(occupied).crop(GetParam(), kWindow);
  for (const Grid<float>& channel : {crop.strokes, crop.nearness}) {
    const double here = agreement(raster.end_points, channel, {0, 0});
    const double dx = peak(agreement(raster.end_points, channel, {-1, 0}), here,
                           agreement(raster.end_points, channel, {1, 0}));
    const double dy = peak(agreement(raster.end_points, channel, {0, -1}), here,
                           agreement(raster.end_points, channel, {0, 1}));
    EXPECT_LT(std::abs(dx), 0.15);
    EXPECT_LT(std::abs(dy), 0.15);
  }
}

TEST_P(SketchCropOverlay, ExpectsTheFreeSpaceThatTheScanSaw) {
  const Grid<std::uint8_t> occupied = room();
  const Scan scan = testing::simulated_scan(occupied, GetParam(), 360);
  const Grid<float> seen = raster_free_space(scan, kWindow);
  const SketchCrop crop = SketchCropper(occupied).crop(GetParam(), kWindow);
  double difference = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < seen.cells().size(); ++i) {
    difference += std::abs(seen.cells()[i] - crop.visible_free.cells()[i]);
    total += seen.cells()[i];
  }
  EXPECT_LT(difference, 0.02 * total);
}

INSTANTIATE_TEST_SUITE_P(Poses, SketchCropOverlay,
                         ::testing::Values(Sim2::from_xy_yaw_scale(80.0, 60.0, 0.0, kPxPerM),
                                           Sim2::from_xy_yaw_scale(73.3, 91.7, 0.6, kPxPerM),
                                           Sim2::from_xy_yaw_scale(101.1, 42.9, -2.3, kPxPerM)));

TEST(SketchCrop, TurnsAndScalesTheDrawingByThePrior) {
  Grid<std::uint8_t> occupied(200, 200);
  occupied.at({100, 140}) = 1;  // 40 px in front of a robot that looks up
  const Sim2 prior = Sim2::from_xy_yaw_scale(100.5, 100.5, rad_from_deg(90.0), 10.0);
  const SketchCrop crop = SketchCropper(occupied).crop(prior, kWindow);
  // 4 m ahead: cell units (40, 24); a px of 0.1 m is 0.4 cells
  EXPECT_GT(crop.strokes.at({39, 23}), 0.05F);
  EXPECT_NEAR(crop.nearness.at({39, 23}), 1.0 - 0.7071 / SketchCrop::kNearnessReach_cells, 5e-3);
  EXPECT_NEAR(std::accumulate(crop.strokes.cells().begin(), crop.strokes.cells().end(), 0.0), 0.4,
              1e-4);
}

TEST(SketchCrop, NeverLosesAThinLineHoweverMuchItShrinks) {
  Grid<std::uint8_t> occupied(400, 400);
  for (int y = 0; y < 400; ++y) {
    occupied.at({200, y}) = 1;
  }
  const SketchCropper cropper(occupied);
  for (const double px_per_m : {2.0, 10.0, 30.0}) {
    const Sim2 prior = Sim2::from_xy_yaw_scale(200.0, 200.0, 0.3, px_per_m);
    const SketchCrop crop = cropper.crop(prior, {.side_m = 6.0, .cells = 24});
    for (int row = 4; row < 20; ++row) {
      double ink = 0.0;
      for (const float cell : crop.strokes.row(row)) {
        ink += static_cast<double>(cell);
      }
      EXPECT_GT(ink, 0.6) << px_per_m << " px/m, row " << row;
    }
  }
}

TEST(SketchCrop, LeavesNoHolesWherePixelsAreLargerThanCells) {
  const Grid<std::uint8_t> occupied(40, 40, 1);
  const Sim2 prior = Sim2::from_xy_yaw_scale(20.0, 20.0, 0.7, 1.5);  // a px is 2.7 cells wide
  const SketchCrop crop = SketchCropper(occupied).crop(prior, kWindow);
  for (const float cell : crop.strokes.cells()) {
    EXPECT_NEAR(cell, 1.0F, 0.35F);
  }
}

TEST(SketchCrop, IsEmptyBesideTheDrawing) {
  const Sim2 prior = Sim2::from_xy_yaw_scale(5000.0, -3000.0, 0.0, kPxPerM);
  const SketchCrop crop = SketchCropper(room()).crop(prior, kWindow);
  for (const float cell : crop.strokes.cells()) {
    EXPECT_EQ(cell, 0.0F);
  }
  for (const float cell : crop.nearness.cells()) {
    EXPECT_EQ(cell, 0.0F);
  }
}

TEST(SketchCrop, FindsTheInkAroundAPoint) {
  const Grid<std::uint8_t> occupied = room();
  const SketchCropper cropper(occupied);
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(80.0, 60.0), Eigen::Vector2d(10.5, 150.5), Eigen::Vector2d(-30.0, 170.0),
        Eigen::Vector2d(205.3, 3.7), Eigen::Vector2d(9000.0, -9000.0)}) {
    for (const double radius_px : {0.0, 50.0, 71.3, 1e9}) {
      std::vector<Eigen::Vector2d> expected;
      for (int row = 0; row < occupied.height(); ++row) {
        for (int column = 0; column < occupied.width(); ++column) {
          const Eigen::Vector2d centre(column + 0.5, row + 0.5);
          if (occupied.at({column, row}) != 0 && (centre - point).norm() <= radius_px) {
            expected.push_back(centre);
          }
        }
      }
      EXPECT_EQ(cropper.ink_near(point, radius_px), expected) << point.transpose();
    }
  }
}

TEST(SketchCrop, KeepsThePublishedCropUprightAndBinary) {
  Grid<std::uint8_t> occupied(200, 200);
  occupied.at({120, 100}) = 1;
  const Grid<float> crop = SketchCropper(occupied).upright_crop({100.0, 100.0}, 80.0, 40);
  EXPECT_EQ(crop.at({30, 20}), 1.0F);
  EXPECT_EQ(std::accumulate(crop.cells().begin(), crop.cells().end(), 0.0F), 1.0F);
}

TEST(SketchCrop, TakesTheOutlineOfPaintedFreeSpace) {
  Sketch sketch{.occupied = Grid<std::uint8_t>(60, 60, 1),
                .kind = Sketch::Kind::FilledFreeSpace,
                .px_per_m = {}};
  for (int row = 20; row < 40; ++row) {
    std::ranges::fill(sketch.occupied.row(row).subspan(20, 20), std::uint8_t{0});
  }
  EXPECT_EQ(SketchCropper(sketch).ink_near({30.0, 30.0}, 100.0).size(), 4U * 20U);
  sketch.kind = Sketch::Kind::Strokes;
  EXPECT_EQ(SketchCropper(sketch).ink_near({30.0, 30.0}, 100.0).size(), 60U * 60U - 20U * 20U);
}

TEST(SketchCrop, TakesABlankSheet) {
  const Grid<std::uint8_t> occupied(30, 20);
  const Sim2 prior = Sim2::from_xy_yaw_scale(15.0, 10.0, 0.0, 2.0);
  const SketchCrop crop = SketchCropper(occupied).crop(prior, kWindow);
  for (const float cell : crop.nearness.cells()) {
    EXPECT_EQ(cell, 0.0F);
  }
}

}  // namespace
}  // namespace sketchloc

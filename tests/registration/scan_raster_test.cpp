#include "registration/scan_raster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "motion/angles.hpp"

namespace sketchloc {
namespace {

const LocalWindow kWindow{.side_m = 8.0, .cells = 32};  // cells of 0.25 m

/// Beams all around at one range.
Scan round_scan(float range_m, int beams = 360) {
  return {.first_angle_rad = -rad_from_deg(180.0),
          .angle_step_rad = rad_from_deg(360.0 / beams),
          .max_range_m = 10.0,
          .robot_from_laser = {},
          .ranges_m = std::vector<float>(static_cast<std::size_t>(beams), range_m)};
}

Scan single_beam(double angle_rad, float range_m) {
  return {.first_angle_rad = angle_rad,
          .angle_step_rad = rad_from_deg(1.0),
          .max_range_m = 10.0,
          .robot_from_laser = {},
          .ranges_m = {range_m}};
}

ScanRaster raster_one(const Scan& scan, const Se2& robot_from_then = {}) {
  const std::vector<PlacedScan> scans = {{.scan = &scan, .robot_from_then = robot_from_then}};
  return raster_scans(scans, kWindow);
}

TEST(ScanRaster, SharesAnEndPointOutAroundItsPlace) {
  const Scan scan = single_beam(0.0, 1.0F);  // cell units (20, 16): a corner of four cells
  const Grid<float> cells = raster_one(scan).end_points;
  EXPECT_NEAR(cells.at({19, 15}), 0.25, 1e-5);
  EXPECT_NEAR(cells.at({20, 16}), 0.25, 1e-5);
  EXPECT_NEAR(std::accumulate(cells.cells().begin(), cells.cells().end(), 0.0), 1.0, 1e-5);
}

TEST(ScanRaster, KeepsTheMeanPlaceOfAnEndPoint) {
  const Scan scan = single_beam(0.4, 2.33F);
  const Grid<float> cells = raster_one(scan).end_points;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int row = 0; row < cells.height(); ++row) {
    for (int column = 0; column < cells.width(); ++column) {
      mean += static_cast<double>(cells.at({column, row})) * centre_of({column, row});
    }
  }
  const Eigen::Vector2d point(2.33 * std::cos(0.4), 2.33 * std::sin(0.4));
  EXPECT_LT((mean - kWindow.cells_from_robot() * point).norm(), 1e-4);
}

TEST(ScanRaster, CountsFreeWhatBeamsPassed) {
  const Scan scan = round_scan(2.0F);
  const Grid<float> seen_free = raster_one(scan).seen_free;
  double area_m2 = 0.0;
  for (const float cell : seen_free.cells()) {
    area_m2 += static_cast<double>(cell) * kWindow.cell_m() * kWindow.cell_m();
  }
  EXPECT_NEAR(area_m2, std::numbers::pi * 4.0, 0.1);
  EXPECT_EQ(seen_free.at({16, 16}), 1.0F);
  EXPECT_EQ(seen_free.at({1, 1}), 0.0F);
}

TEST(ScanRaster, SeesOnlyTheFieldOfView) {
  Scan scan = round_scan(3.0F);
  scan.first_angle_rad = rad_from_deg(-45.0);
  scan.ranges_m.resize(91);
  const Grid<float> seen_free = raster_one(scan).seen_free;
  EXPECT_EQ(seen_free.at({24, 16}), 1.0F);  // 2 m ahead
  EXPECT_EQ(seen_free.at({24, 22}), 1.0F);
  EXPECT_EQ(seen_free.at({16, 24}), 0.0F);  // left
  EXPECT_EQ(seen_free.at({8, 16}), 0.0F);   // behind
}

TEST(ScanRaster, LearnsNothingFromBeamsWithoutReturn) {
  const Scan scan = round_scan(10.0F);
  const ScanRaster raster = raster_one(scan);
  for (const float cell : raster.seen_free.cells()) {
    EXPECT_EQ(cell, 0.0F);
  }
  for (const float cell : raster.end_points.cells()) {
    EXPECT_EQ(cell, 0.0F);
  }
}

TEST(ScanRaster, PlacesEarlierScansWhereTheyWereTaken) {
  const Scan scan = single_beam(0.0, 1.0F);
  const Se2 robot_from_then = Se2::from_xy_yaw(-1.0, 0.5, rad_from_deg(90.0));
  const Grid<float> cells = raster_one(scan, robot_from_then).end_points;
  // (-1, 1.5) m is (12, 22) in cell units
  EXPECT_NEAR(cells.at({11, 21}) + cells.at({12, 21}) + cells.at({11, 22}) + cells.at({12, 22}),
              1.0, 1e-5);
}

TEST(ScanRaster, TurnsScansThatCountClockwiseTheSameWay) {
  Scan forth = round_scan(2.0F, 91);
  forth.first_angle_rad = rad_from_deg(-45.0);
  forth.angle_step_rad = rad_from_deg(1.0);
  Scan back = forth;
  back.first_angle_rad = rad_from_deg(45.0);
  back.angle_step_rad = -rad_from_deg(1.0);
  const Grid<float> forth_free = raster_free_space(forth, kWindow);
  const Grid<float> back_free = raster_free_space(back, kWindow);
  for (std::size_t i = 0; i < forth_free.cells().size(); ++i) {
    EXPECT_NEAR(forth_free.cells()[i], back_free.cells()[i], 1e-6);
  }
}

TEST(ScanRaster, MarksTheCellOfEveryEndPointForThePublishedPicture) {
  const Scan scan = single_beam(0.0, 1.1F);
  const Grid<float> cells = binary_scan_raster(scan, kWindow);
  EXPECT_EQ(cells.at({20, 16}), 1.0F);
  EXPECT_EQ(std::accumulate(cells.cells().begin(), cells.cells().end(), 0.0F), 1.0F);
}

TEST(LocalWindow, RefusesSizesThatAreNone) {
  EXPECT_NO_THROW(validate(LocalWindow{}));
  EXPECT_THROW(validate(LocalWindow{.side_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(LocalWindow{.cells = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "registration/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "registration/control_grid.hpp"

namespace sketchloc {
namespace {

constexpr double kPxPerM = 20.0;
const LocalWindow kWindow{.side_m = 10.0, .cells = 64};

/// A wall along x at 60 px, 400 px wide.
SketchCropper wall() {
  Grid<std::uint8_t> occupied(400, 200);
  for (int x = 0; x < 400; ++x) {
    occupied.at({x, 60}) = 1;
  }
  return SketchCropper(occupied);
}

/// One beam to the left that meets something 2 m away, and one that meets something 20 m away.
Scan scan_of_a_wall() {
  return {.first_angle_rad = 0.0,
          .angle_step_rad = std::numbers::pi / 2.0,
          .max_range_m = 30.0,
          .robot_from_laser = {},
          .ranges_m = {20.0F, 2.0F}};
}

double score_at(double y_px) {
  const Scan scan = scan_of_a_wall();
  const PlacedScan placed{.scan = &scan};
  return alignment_score({&placed, 1}, wall(), Sim2::from_xy_yaw_scale(200.0, y_px, 0.0, kPxPerM),
                         kWindow);
}

TEST(AlignmentScore, IsOneOnTheStrokesAndFallsWithTheDistance) {
  const double y_px = 60.5 - 2.0 * kPxPerM;  // the far end point is out of the window
  EXPECT_NEAR(score_at(y_px), 1.0, 1e-3);
  EXPECT_NEAR(score_at(y_px + 3.0), std::exp(-0.5), 1e-3);  // 0.15 m beside it
  EXPECT_LT(score_at(y_px + 20.0), 1e-6);
}

TEST(AlignmentScore, TakesABentScanToWhereTheWarpSays) {
  // The drawing has the wall at half the distance; only the warp knows.
  const Sim2 pose = Sim2::from_xy_yaw_scale(200.0, 60.5 - kPxPerM, 0.0, kPxPerM);
  const std::vector<Eigen::Vector2d> points =
      square_lattice(kControlsPerSide, 10.0, Eigen::Vector2d::Zero());
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : points) {
    places.push_back(pose * Eigen::Vector2d(point.x(), 0.5 * point.y()));
  }
  const Warp warp = *Warp::from_robot_points(points, places);
  const Scan scan = scan_of_a_wall();
  const PlacedScan placed{.scan = &scan};
  // The warp's own scale is sqrt(1/2): what is near is told in shorter metres.
  EXPECT_GT(alignment_score({&placed, 1}, wall(), warp, kWindow), 0.99);
  EXPECT_LT(alignment_score({&placed, 1}, wall(), pose, kWindow), 0.01);
}

TEST(AlignmentScore, IsZeroWithoutEndPointsOrStrokes) {
  Scan scan = scan_of_a_wall();
  const PlacedScan placed{.scan = &scan};
  const SketchCropper nothing(Grid<std::uint8_t>(50, 50));
  const Sim2 pose = Sim2::from_xy_yaw_scale(25.0, 25.0, 0.0, kPxPerM);
  EXPECT_EQ(alignment_score({&placed, 1}, nothing, pose, kWindow), 0.0);
  scan.ranges_m = {40.0F, 40.0F};
  EXPECT_EQ(alignment_score({&placed, 1}, wall(), pose, kWindow), 0.0);
}

}  // namespace
}  // namespace sketchloc

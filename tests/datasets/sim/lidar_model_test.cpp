#include "datasets/sim/lidar_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sketchloc {
namespace {

constexpr double kPi = std::numbers::pi;

/// A room of 10 m x 6 m, its corner at the world's origin, with walls one cell thick.
MetricMap room() {
  MetricMap map{.cells = Grid<std::uint8_t>(202, 122), .origin_in_world = {-0.05, -0.05}};
  for (int column = 0; column < 202; ++column) {
    map.cells.at({column, 0}) = map.cells.at({column, 121}) = MetricMap::Solid;
  }
  for (int row = 0; row < 122; ++row) {
    map.cells.at({0, row}) = map.cells.at({201, row}) = MetricMap::Solid;
  }
  return map;
}

LidarModel exact() {
  return {.beams = 5, .range_sigma_m = 0.0, .dropout_share = 0.0, .short_share = 0.0};
}

TEST(LidarSimulator, MeasuresTheRoomFromRightToLeft) {
  Rng rng = make_rng(1);
  const Scan scan = LidarSimulator(room(), exact()).scan(Se2::from_xy_yaw(4.0, 2.0, 0.0), 7.0, rng);
  ASSERT_EQ(scan.ranges_m.size(), 5U);
  EXPECT_EQ(scan.time_s, 7.0);
  EXPECT_NEAR(scan.angle_rad(0), -kPi / 2.0, 1e-12);
  EXPECT_NEAR(scan.angle_rad(4), kPi / 2.0, 1e-12);
  EXPECT_NEAR(scan.ranges_m[0], 2.0, 1e-4);
  EXPECT_NEAR(scan.ranges_m[1], 2.0 * std::numbers::sqrt2, 1e-4);
  EXPECT_NEAR(scan.ranges_m[2], 6.0, 1e-4);
  EXPECT_NEAR(scan.ranges_m[3], 4.0 * std::numbers::sqrt2, 1e-4);
  EXPECT_NEAR(scan.ranges_m[4], 4.0, 1e-4);
}

TEST(LidarSimulator, TurnsWithTheRobotAndSitsWhereItIsMounted) {
  LidarModel model = exact();
  model.forward_m = 0.5;
  Rng rng = make_rng(1);
  const Scan scan =
      LidarSimulator(room(), model).scan(Se2::from_xy_yaw(4.0, 2.0, kPi / 2.0), 0.0, rng);
  EXPECT_NEAR(scan.ranges_m[2], 3.5, 1e-4);  // forward is +y now, and the laser is half a metre on
  EXPECT_NEAR(scan.ranges_m[0], 6.0, 1e-4);
  EXPECT_NEAR(scan.robot_from_laser.x_m(), 0.5, 1e-12);
}

TEST(LidarSimulator, DoesNotReturnBeyondItsRange) {
  LidarModel model = exact();
  model.max_range_m = 5.0;
  Rng rng = make_rng(1);
  const Scan scan = LidarSimulator(room(), model).scan(Se2::from_xy_yaw(4.0, 2.0, 0.0), 0.0, rng);
  EXPECT_FALSE(scan.is_return(2));
  EXPECT_TRUE(scan.is_return(0));
}

TEST(LidarSimulator, SeesNoDirectionTwiceInAFullTurn) {
  LidarModel model = exact();
  model.field_of_view_rad = 2.0 * kPi;
  model.beams = 4;
  Rng rng = make_rng(1);
  const Scan scan = LidarSimulator(room(), model).scan(Se2::from_xy_yaw(4.0, 2.0, 0.0), 0.0, rng);
  EXPECT_NEAR(scan.angle_step_rad, kPi / 2.0, 1e-12);
  EXPECT_NEAR(scan.ranges_m[0], 4.0, 1e-4);  // straight back
  EXPECT_NEAR(scan.ranges_m[2], 6.0, 1e-4);
}

TEST(LidarSimulator, GoesThroughGlassOrStopsAtIt) {
  MetricMap map = room();
  for (int row = 1; row < 121; ++row) {
    map.cells.at({141, row}) = MetricMap::Glass;  // at x = 7 m
  }
  Rng rng = make_rng(1);
  LidarModel model = exact();
  model.glass_pass_share = 1.0;
  const Se2 world_from_robot = Se2::from_xy_yaw(4.0, 2.0, 0.0);
  EXPECT_NEAR(LidarSimulator(map, model).scan(world_from_robot, 0.0, rng).ranges_m[2], 6.0, 1e-4);
  model.glass_pass_share = 0.0;
  EXPECT_NEAR(LidarSimulator(map, model).scan(world_from_robot, 0.0, rng).ranges_m[2], 3.0, 1e-4);
}

TEST(LidarSimulatorStatistical, HasTheNoiseAndTheDropoutsOfItsModel) {
  LidarModel model = exact();
  model.beams = 181;
  model.range_sigma_m = 0.03;
  model.dropout_share = 0.1;
  const LidarSimulator noisy(room(), model);
  const LidarSimulator clear(
      room(),
      LidarModel{.beams = 181, .range_sigma_m = 0.0, .dropout_share = 0.0, .short_share = 0.0});
  const Se2 world_from_robot = Se2::from_xy_yaw(4.0, 3.0, 0.3);
  Rng rng = make_rng(1);
  const Scan truth = clear.scan(world_from_robot, 0.0, rng);
  double returns = 0.0;
  double squares = 0.0;
  constexpr int kScans = 100;
  for (int i = 0; i < kScans; ++i) {
    const Scan scan = noisy.scan(world_from_robot, 0.0, rng);
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      if (scan.is_return(beam)) {
        returns += 1.0;
        squares += std::pow(scan.ranges_m[beam] - truth.ranges_m[beam], 2);
      }
    }
  }
  const double beams = kScans * 181.0;
  EXPECT_NEAR(returns / beams, 0.9, 5.0 * std::sqrt(0.9 * 0.1 / beams));
  const double sigma_m = std::sqrt(squares / returns);
  EXPECT_NEAR(sigma_m, 0.03, 5.0 * 0.03 / std::sqrt(2.0 * returns));
}

TEST(LidarModel, RejectsValuesOutOfRangeByName) {
  EXPECT_NO_THROW(validate(LidarModel{}));
  EXPECT_THROW(validate(LidarModel{.beams = 1}), std::invalid_argument);
  EXPECT_THROW(validate(LidarModel{.dropout_share = 1.5}), std::invalid_argument);
  EXPECT_THROW(validate(LidarModel{.max_range_m = 0.01}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

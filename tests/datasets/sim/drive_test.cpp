#include "datasets/sim/drive.hpp"

#include <gtest/gtest.h>

#include "datasets/sim/plan_generators.hpp"
#include "motion/angles.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

Building office(std::uint64_t seed) {
  Rng rng = make_rng(seed);
  return building_from_plan(make_office(rng));
}

MetricTrajectory driven(const Building& building, const DriveParams& params = {}) {
  Rng rng = make_rng(5);
  const Drive drive = drive_through(building, params, rng);
  EXPECT_EQ(drive.status, Drive::Status::Driven);
  return drive.world_from_robot;
}

/// One room with walls around.
Building single_room(double side_m) {
  FloorPlan plan;
  plan.rooms.push_back({.box_in_world = {{0.0, 0.0}, {side_m, side_m}}});
  for (const RoomEdge& edge : find_edges(plan.rooms)) {
    plan.walls.push_back({.from_in_world = edge.from_in_world, .to_in_world = edge.to_in_world});
  }
  return building_from_plan(std::move(plan));
}

TEST(Drive, KeepsClearOfWallsAndThings) {
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    const Building building = office(seed);
    const Grid<float> distance_cells = distance_field_px(building.map.cells);
    for (const Stamped<Se2>& stamped : driven(building)) {
      const Eigen::Vector2d cells = building.map.cells_from_world(stamped.pose.translation());
      const double distance_m = building.map.cell_m * sample(distance_cells, cells).value_or(0.0F);
      EXPECT_GT(distance_m, DriveParams{}.robot_radius_m - 0.05);
    }
  }
}

TEST(Drive, TakesScansAtTheWantedSpacing) {
  const MetricTrajectory poses = driven(office(1));
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Se2 step = poses[i - 1].pose.inverse() * poses[i].pose;
    EXPECT_LT(step.translation().norm(), 0.4 + 0.06);
    EXPECT_LT(std::abs(step.yaw_rad()), 0.3 + 0.35);
    EXPECT_GT(step.translation().norm() / 0.4 + std::abs(step.yaw_rad()) / 0.3, 0.6);
  }
}

TEST(Drive, GoesForwardMostOfTheWay) {
  const MetricTrajectory poses = driven(office(2));
  double forward_m = 0.0;
  double way_m = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Se2 step = poses[i - 1].pose.inverse() * poses[i].pose;
    forward_m += step.x_m();
    way_m += step.translation().norm();
  }
  EXPECT_GT(forward_m, 0.9 * way_m);
  EXPECT_GT(way_m, 0.8 * DriveParams{}.length_m);
}

TEST(Drive, TakesTheTimeOfItsSpeed) {
  const MetricTrajectory poses = driven(office(2), {.length_m = 30.0, .speed_mps = 0.25});
  EXPECT_GT(poses[poses.size() - 1].time_s - poses[0].time_s, 30.0 / 0.25 * 0.8);
}

TEST(Drive, SaysWhenTheRobotFitsNowhere) {
  Rng rng = make_rng(1);
  EXPECT_EQ(drive_through(single_room(3.0), {.robot_radius_m = 2.0}, rng).status,
            Drive::Status::NoFreeSpace);
}

TEST(Drive, GoesOnWhereManyGoalsAreTooNear) {
  EXPECT_GT(driven(single_room(2.4), {.length_m = 150.0}).size(), 300U);
}

TEST(Drive, SaysWhenThereIsNowhereToGo) {
  Rng rng = make_rng(1);
  EXPECT_EQ(drive_through(single_room(1.2), {}, rng).status, Drive::Status::Confined);
}

TEST(DriveParams, RejectValuesOutOfRange) {
  EXPECT_NO_THROW(validate(DriveParams{}));
  EXPECT_THROW(validate(DriveParams{.speed_mps = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(DriveParams{.length_m = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

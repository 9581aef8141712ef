#include "datasets/sim/place_labels.hpp"

#include <gtest/gtest.h>

#include <array>

#include "datasets/sim/drive.hpp"
#include "datasets/sim/plan_generators.hpp"

namespace sketchloc {
namespace {

/// A hall of 30 m x 20 m with two columns of three racks (10 m x 2 m each): aisles of 3 m along x,
/// cross aisles of 3 m at the ends and of 4 m between.
FloorPlan small_warehouse() {
  FloorPlan plan;
  plan.rooms.push_back({.use = Room::Use::Hall, .box_in_world = {{0.0, 0.0}, {30.0, 18.0}}});
  const std::array<Eigen::Vector2d, 4> corners = {
      {{0.0, 0.0}, {30.0, 0.0}, {30.0, 18.0}, {0.0, 18.0}}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    plan.walls.push_back({.from_in_world = corners[i], .to_in_world = corners[(i + 1) % 4]});
  }
  for (const double x : {8.0, 22.0}) {
    for (const double y : {4.0, 9.0, 14.0}) {
      plan.furniture.push_back(
          {.centre_in_world = {x, y}, .half_size_m = {5.0, 1.0}, .structural = true});
    }
  }
  return plan;
}

PlaceLabel label_at(double x, double y) {
  return PlaceLabeller(small_warehouse()).label_at({x, y});
}

TEST(PlaceLabels, CallRackspaceWhatLiesAlongRacks) {
  EXPECT_EQ(label_at(8.0, 6.5), PlaceLabel::Rackspace);
  EXPECT_EQ(label_at(26.9, 11.5), PlaceLabel::Rackspace);
  EXPECT_EQ(label_at(8.0, 1.5), PlaceLabel::Rackspace);  // a wall on the other side
}

TEST(PlaceLabels, CallCorridorWhatLeadsFromAisleToAisle) {
  EXPECT_EQ(label_at(15.0, 9.0), PlaceLabel::Corridor);  // the ends of racks on both sides
  EXPECT_EQ(label_at(1.5, 9.0), PlaceLabel::Corridor);   // and a wall on one
}

TEST(PlaceLabels, CallIntersectionWhereThreeWaysMeetOrFour) {
  EXPECT_EQ(label_at(15.0, 6.5), PlaceLabel::Intersection);  // an aisle on either side
  EXPECT_EQ(label_at(1.5, 6.5), PlaceLabel::Intersection);  // an aisle and both ways along the wall
  EXPECT_EQ(label_at(15.0, 1.5), PlaceLabel::Intersection);  // from the wall up the cross aisle
}

TEST(PlaceLabels, ChangeWhereTheRackEnds) {
  EXPECT_EQ(label_at(12.99, 6.5), PlaceLabel::Rackspace);
  EXPECT_EQ(label_at(13.01, 6.5), PlaceLabel::Intersection);
}

TEST(PlaceLabels, CallACornerACorridor) {
  EXPECT_EQ(label_at(1.5, 1.5), PlaceLabel::Corridor);  // two ways
}

TEST(PlaceLabels, DoNotMindWhatLiesAbout) {
  FloorPlan plan = small_warehouse();
  plan.furniture.push_back({.centre_in_world = {16.0, 7.0}, .half_size_m = {0.5, 0.4}});
  EXPECT_EQ(PlaceLabeller(plan).label_at({15.0, 7.0}), PlaceLabel::Intersection);
}

TEST(PlaceLabels, CallARoomACorridorHoweverLarge) {
  FloorPlan plan = small_warehouse();
  plan.rooms.front().use = Room::Use::Room;
  EXPECT_EQ(PlaceLabeller(plan).label_at({15.0, 6.5}), PlaceLabel::Corridor);
}

TEST(PlaceLabels, KnowRacksFromPallets) {
  EXPECT_TRUE(has_racks(small_warehouse()));
  FloorPlan plan = small_warehouse();
  for (Furniture& thing : plan.furniture) {
    thing.structural = false;
  }
  EXPECT_FALSE(has_racks(plan));
}

TEST(PlaceLabels, MeetAllKindsOnADriveThroughAGeneratedWarehouse) {
  Rng rng = make_rng(11);
  const Building building = building_from_plan(make_warehouse(rng));
  const Drive drive = drive_through(building, {.length_m = 200.0}, rng);
  ASSERT_EQ(drive.status, Drive::Status::Driven);
  const std::vector<PlaceLabel> labels =
      PlaceLabeller(building.plan).labels(drive.world_from_robot);
  ASSERT_EQ(labels.size(), drive.world_from_robot.size());
  for (const PlaceLabel label :
       {PlaceLabel::Rackspace, PlaceLabel::Corridor, PlaceLabel::Intersection}) {
    EXPECT_GT(std::ranges::count(labels, label), std::ssize(labels) / 20) << name_of(label);
  }
}

}  // namespace
}  // namespace sketchloc

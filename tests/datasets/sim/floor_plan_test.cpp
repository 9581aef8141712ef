#include "datasets/sim/floor_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace sketchloc {
namespace {

Room room(double left, double bottom, double right, double top) {
  return {.box_in_world = {{left, bottom}, {right, top}}};
}

double total_length_m(const std::vector<RoomEdge>& edges, bool outer) {
  double sum = 0.0;
  for (const RoomEdge& edge : edges) {
    sum += edge.outer() == outer ? edge.length_m() : 0.0;
  }
  return sum;
}

TEST(FindEdges, GivesFourOuterSidesToARoomAlone) {
  const std::vector<Room> rooms = {room(0, 0, 4, 3)};
  const std::vector<RoomEdge> edges = find_edges(rooms);
  EXPECT_EQ(edges.size(), 4U);
  EXPECT_DOUBLE_EQ(total_length_m(edges, true), 14.0);
}

TEST(FindEdges, SplitsASideWhereANeighbourEnds) {
  const std::vector<Room> rooms = {room(0, 0, 4, 3), room(4, 1, 6, 5)};
  const std::vector<RoomEdge> edges = find_edges(rooms);
  EXPECT_DOUBLE_EQ(total_length_m(edges, false), 2.0);  // x = 4, y from 1 to 3, once
  EXPECT_DOUBLE_EQ(total_length_m(edges, true), 14.0 + 12.0 - 2.0 * 2.0);
  const auto shared = std::ranges::find_if(edges, [](const RoomEdge& e) { return !e.outer(); });
  ASSERT_NE(shared, edges.end());
  EXPECT_EQ(shared->first, 0U);
  EXPECT_EQ(shared->second, 1U);
  EXPECT_EQ(shared->from_in_world, Eigen::Vector2d(4, 1));
  EXPECT_EQ(shared->to_in_world, Eigen::Vector2d(4, 3));
}

TEST(FindEdges, DoesNotJoinRoomsThatTouchInACorner) {
  const std::vector<Room> rooms = {room(0, 0, 2, 2), room(2, 2, 4, 4)};
  EXPECT_DOUBLE_EQ(total_length_m(find_edges(rooms), false), 0.0);
}

TEST(FindEdges, HasNoEdgesWithoutRooms) { EXPECT_TRUE(find_edges({}).empty()); }

TEST(FurnitureCorners, TurnCounterClockwiseAboutTheCentre) {
  const Furniture desk = {
      .centre_in_world = {5.0, 1.0}, .half_size_m = {2.0, 1.0}, .yaw_rad = std::numbers::pi / 2.0};
  const std::vector<Eigen::Vector2d> corners = desk.corners_in_world();
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_TRUE(corners[0].isApprox(Eigen::Vector2d(6.0, -1.0), 1e-12));
  EXPECT_TRUE(corners[1].isApprox(Eigen::Vector2d(6.0, 3.0), 1e-12));
  EXPECT_TRUE(corners[2].isApprox(Eigen::Vector2d(4.0, 3.0), 1e-12));
}

TEST(PlanBounds, HoldRoomsAndWalls) {
  FloorPlan plan{.rooms = {room(1, 1, 3, 3)}};
  plan.walls.push_back({.from_in_world = {-2.0, 2.0}, .to_in_world = {2.0, 7.0}});
  const PlaneBox bounds = bounds_in_world(plan);
  EXPECT_EQ(bounds.low, Eigen::Vector2d(-2.0, 1.0));
  EXPECT_EQ(bounds.high, Eigen::Vector2d(3.0, 7.0));
}

}  // namespace
}  // namespace sketchloc

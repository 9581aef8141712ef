#include "topology/straight_pieces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "tests/support/aisle_drive.hpp"

namespace sketchloc {
namespace {

std::vector<StraightPiece> pieces_of(const std::vector<Se2>& poses,
                                     const StraightParams& params = {}) {
  return straight_pieces(poses, travel_of(poses), params);
}

std::vector<Se2> straight_line(double length_m, double yaw_rad, double drive_rad) {
  std::vector<Se2> poses;
  for (int i = 0; i * 0.1 <= length_m + 1e-9; ++i) {
    poses.push_back(
        Se2::from_xy_yaw(0.1 * i * std::cos(drive_rad), 0.1 * i * std::sin(drive_rad), yaw_rad));
  }
  return poses;
}

TEST(StraightPieces, CutALongWayIntoPiecesWithTheDirectionOfTheWay) {
  const auto pieces = pieces_of(straight_line(7.0, 0.30, 0.35));
  ASSERT_EQ(pieces.size(), 3U);
  for (const StraightPiece& piece : pieces) {
    EXPECT_NEAR(piece.axis_rad, 0.35, 1e-9);
    EXPECT_LE(piece.length_m, 3.0);
  }
  EXPECT_LT(pieces[0].last, pieces[1].first);
}

TEST(StraightPieces, LookWhereTheRobotLooksThatDrivesBackwards) {
  const auto pieces = pieces_of(straight_line(2.0, 0.3, 0.3 + std::numbers::pi));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(pieces[0].axis_rad, 0.3, 1e-9);
}

TEST(StraightPieces, LeaveOutTurns) {
  Rng rng = make_rng(1);
  const auto drive = testing::aisle_drive({.aisles = 2}, rng);
  const Travel travel = travel_of(drive.odom_from_robot);
  for (const StraightPiece& piece : pieces_of(drive.odom_from_robot)) {
    EXPECT_LT(std::abs(travel.yaw_rad[piece.last] - travel.yaw_rad[piece.first]), 0.27);
    EXPECT_NEAR(piece.axis_rad, angle_rad(nearest_quarter_turns(piece.axis_rad)), 0.1);
  }
}

TEST(StraightPieces, AreNotFoundWhereTheRobotStandsOrCreeps) {
  EXPECT_TRUE(pieces_of({}).empty());
  EXPECT_TRUE(pieces_of(std::vector<Se2>(50)).empty());
  EXPECT_TRUE(pieces_of(straight_line(0.5, 0.0, 0.0)).empty());
}

TEST(StraightPieces, RefuseParametersOutOfRange) {
  EXPECT_THROW(validate(StraightParams{.window_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(StraightParams{.most_turn_deg = 45.0}), std::invalid_argument);
  EXPECT_THROW(validate(StraightParams{.shortest_m = 2.0, .longest_m = 1.0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "topology/travel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using testing::IsNear;

TEST(Travel, CountsTheWayAndUnwrapsTheHeading) {
  const std::vector<Se2> poses = {Se2::from_xy_yaw(0.0, 0.0, 3.0), Se2::from_xy_yaw(3.0, 4.0, -3.0),
                                  Se2::from_xy_yaw(3.0, 4.0, -2.0)};
  const Travel travel = travel_of(poses);
  EXPECT_THAT(travel.way_m, ElementsAre(0.0, 5.0, 5.0));
  EXPECT_THAT(travel.yaw_rad, ElementsAre(3.0, DoubleNear(2.0 * std::numbers::pi - 3.0, 1e-12),
                                          DoubleNear(2.0 * std::numbers::pi - 2.0, 1e-12)));
}

TEST(Travel, KeepsTheStepsUnderOtherHeadings) {
  const std::vector<Se2> poses = {Se2::from_xy_yaw(1.0, 2.0, 0.5), Se2::from_xy_yaw(2.0, 2.5, 0.6),
                                  Se2::from_xy_yaw(2.0, 3.5, 1.6)};
  const Se2 turned = Se2::from_xy_yaw(0.0, 0.0, 0.3);
  const std::vector<Se2> result = with_headings(poses, std::vector<double>{0.8, 0.9, 1.9});
  ASSERT_EQ(result.size(), poses.size());
  EXPECT_THAT(result[0], IsNear(Se2::from_xy_yaw(1.0, 2.0, 0.8), 1e-12));
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_THAT(result[0].inverse() * result[i], IsNear(poses[0].inverse() * poses[i], 1e-12));
  }
  EXPECT_NEAR(turned.yaw_rad(), result[1].yaw_rad() - poses[1].yaw_rad(), 1e-12);
}

TEST(Travel, OfNothingIsNothing) {
  EXPECT_TRUE(travel_of({}).way_m.empty());
  EXPECT_TRUE(with_headings({}, {}).empty());
}

TEST(QuarterTurns, AreMultiplesOfARightAngle) {
  EXPECT_EQ(nearest_quarter_turns(-1.5), -1);
  EXPECT_EQ(nearest_quarter_turns(0.7), 0);
  EXPECT_EQ(nearest_quarter_turns(7.0), 4);
  EXPECT_DOUBLE_EQ(angle_rad(-3), -1.5 * std::numbers::pi);
}

}  // namespace
}  // namespace sketchloc

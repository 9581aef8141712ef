#include "eval/goal_estimator.hpp"

#include <gtest/gtest.h>

namespace sketchloc {
namespace {

using Eigen::Vector2d;

PlaceLook look(const Vector2d& place_in_robot, double sigma_m) {
  return {.place_in_robot = place_in_robot,
          .covariance_m2 = sigma_m * sigma_m * Eigen::Matrix2d::Identity()};
}

TEST(GoalEstimator, JoinsLooksFromDifferentPosesByOdometry) {
  GoalEstimator goal(9);
  goal.add(look({2.0, 0.0}, 0.2), Se2::from_xy_yaw(1.0, 0.0, 0.0));
  goal.add(look({0.0, -2.0}, 0.2), Se2::from_xy_yaw(1.0, 0.0, 0.5 * 3.14159265358979));
  EXPECT_NEAR((goal.goal_in_odom() - Vector2d(3.0, 0.0)).norm(), 0.0, 1e-9);
}

TEST(GoalEstimator, BelievesExactLooksMore) {
  GoalEstimator goal(9);
  goal.add(look({0.0, 0.0}, 0.1), Se2());
  goal.add(look({0.1, 0.0}, 0.3), Se2());
  EXPECT_GT(goal.goal_in_odom().x(), 0.0);
  EXPECT_LT(goal.goal_in_odom().x(), 0.03);
}

TEST(GoalEstimator, HardlyHearsALookThatContradictsTheOthers) {
  GoalEstimator goal(9);
  for (int i = 0; i < 8; ++i) {
    goal.add(look({1.0, 0.0}, 0.2), Se2());
  }
  goal.add(look({6.0, 0.0}, 0.2), Se2());
  EXPECT_NEAR(goal.goal_in_odom().x(), 1.0, 0.1);
}

TEST(GoalEstimator, ForgetsWhatIsOld) {
  GoalEstimator goal(2);
  goal.add(look({5.0, 0.0}, 0.2), Se2());
  goal.add(look({1.0, 0.0}, 0.2), Se2());
  goal.add(look({1.0, 0.0}, 0.2), Se2());
  EXPECT_NEAR(goal.goal_in_odom().x(), 1.0, 1e-12);
}

}  // namespace
}  // namespace sketchloc

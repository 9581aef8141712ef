#include "smoothing/keyframe_window.hpp"

#include <gtest/gtest.h>

#include <span>

#include "datasets/run.hpp"
#include "tests/support/no_registrations.hpp"

namespace sketchloc {
namespace {

RunStep step_at(const Se2& odom_from_robot, double time_s) {
  return {.scan = {.time_s = time_s,
                   .angle_step_rad = 0.1,
                   .max_range_m = 10.0,
                   .robot_from_laser = {},
                   .ranges_m = {2.0F}},
          .odom_from_robot = odom_from_robot};
}

TEST(KeyframeWindow, TakesAKeyframeAfterEachWay) {
  testing::NoRegistrations window({.way_m = 0.55});
  for (int i = 0; i < 11; ++i) {
    window.add(step_at(Se2::from_xy_yaw(0.2 * i, 0.0, 0.0), 0.1 * i));
  }
  const std::span<const Keyframe> keyframes = window.keyframes();
  ASSERT_EQ(keyframes.size(), 4U);
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    EXPECT_EQ(keyframes[k].step, 3 * k);
    EXPECT_NEAR(keyframes[k].way_m, k == 0 ? 0.0 : 0.6, 1e-12);
    EXPECT_NEAR(keyframes[k].time_s, 0.3 * static_cast<double>(k), 1e-12);
  }
}

TEST(KeyframeWindow, TakesAKeyframeAfterEachTurnOnTheSpotToo) {
  testing::NoRegistrations window({.turn_rad = 0.5});
  for (int i = 0; i < 9; ++i) {
    window.add(step_at(Se2::from_xy_yaw(0.0, 0.0, 0.3 * i), 0.1 * i));
  }
  EXPECT_EQ(window.keyframes().size(), 5U);
}

TEST(KeyframeWindow, CountsTheScansOfARobotThatStandsAndKeepsNone) {
  testing::NoRegistrations window({.way_m = 0.5});
  for (int i = 0; i < 100; ++i) {
    window.add(step_at(Se2::from_xy_yaw(0.0, 0.0, 0.0), 0.1 * i));
  }
  window.add(step_at(Se2::from_xy_yaw(1.0, 0.0, 0.0), 10.0));
  ASSERT_EQ(window.keyframes().size(), 2U);
  EXPECT_EQ(window.keyframes().back().step, 100U);
}

}  // namespace
}  // namespace sketchloc

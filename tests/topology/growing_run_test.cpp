#include "topology/growing_run.hpp"

#include <gtest/gtest.h>

#include "tests/support/aisle_drive.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::AisleDrive;
using testing::mean_distance_m;

TEST(GrowingRun, EndsNearWhatIsRecoveredAtOnce) {
  Rng rng = make_rng(3);
  const AisleDrive drive =
      testing::aisle_drive({.drift_deg_per_m = 0.8, .turn_error_deg = 2.0}, rng);
  GrowingRun growing;
  std::vector<Se2> online;
  for (std::size_t i = 0; i < drive.odom_from_robot.size(); ++i) {
    growing.add(drive.odom_from_robot[i], drive.labels[i]);
    if (growing.way_since_update_m() >= 5.0) {
      growing.update();
      EXPECT_EQ(growing.way_since_update_m(), 0.0);
    }
    online.push_back(growing.manhattan_from_robot());
  }
  const double at_once_m =
      mean_distance_m(drive.world_from_robot,
                      recover_run(drive.odom_from_robot, drive.labels).manhattan_from_robot);
  EXPECT_LT(mean_distance_m(drive.world_from_robot, growing.update().manhattan_from_robot),
            1.5 * at_once_m + 0.05);
  EXPECT_LT(mean_distance_m(drive.world_from_robot, online), 1.0);
}

TEST(GrowingRun, FollowsTheOdometryBetweenUpdates) {
  GrowingRun growing;
  growing.add(Se2::from_xy_yaw(1.0, 0.0, 0.0), PlaceLabel::Corridor);
  growing.add(Se2::from_xy_yaw(1.5, 0.0, 0.1), PlaceLabel::Corridor);
  EXPECT_THAT(growing.manhattan_from_robot(),
              testing::IsNear(Se2::from_xy_yaw(1.5, 0.0, 0.1), 1e-12));
  EXPECT_NEAR(growing.way_since_update_m(), 0.5, 1e-12);
}

}  // namespace
}  // namespace sketchloc

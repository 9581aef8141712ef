#include "filter/online/intake.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

Scan scan_at(double time_s, std::size_t beams = 3) {
  return {.time_s = time_s,
          .angle_step_rad = 0.1,
          .max_range_m = 10.0,
          .robot_from_laser = {},
          .ranges_m = std::vector<float>(beams, 1.0F)};
}

Message scan_message(double time_s) {
  return {.time_s = time_s, .odom_from_robot = std::nullopt, .scan = scan_at(time_s)};
}

Message odometry(double time_s, double x_m) {
  return {.time_s = time_s, .odom_from_robot = Se2::from_xy_yaw(x_m, 0.0, 0.0), .scan = {}};
}

Message both(double time_s, double x_m) {
  return {.time_s = time_s,
          .odom_from_robot = Se2::from_xy_yaw(x_m, 0.0, 0.0),
          .scan = scan_at(time_s)};
}

/// Gives messages to an intake, each arriving at its time.
class Intaking : public ::testing::Test {
 protected:
  void take(const Message& message) { take(message, message.time_s); }
  void take(const Message& message, double arrived_s) { intake_.take(message, arrived_s); }

  Intake intake_{IntakeParams{}};
};
using IntakeTest = Intaking;

TEST_F(IntakeTest, PassesOnAStepAsItIs) {
  take(both(1.0, 2.0));
  const std::optional<ReadyScan> ready = intake_.next_ready();
  ASSERT_TRUE(ready);
  EXPECT_THAT(ready->step.odom_from_robot, IsNear(Se2::from_xy_yaw(2.0, 0.0, 0.0), 0.0));
  EXPECT_EQ(ready->step.scan.time_s, 1.0);
  EXPECT_FALSE(ready->unmeasured_s);
  EXPECT_FALSE(intake_.next_ready());
}

TEST_F(IntakeTest, InterpolatesTheOdometryAroundAScan) {
  take(odometry(1.0, 0.0));
  take(scan_message(1.025));
  EXPECT_FALSE(intake_.next_ready()) << "it waits for the odometry after it";
  EXPECT_TRUE(intake_.waits());
  take(odometry(1.05, 0.1));
  const std::optional<ReadyScan> ready = intake_.next_ready();
  ASSERT_TRUE(ready);
  EXPECT_THAT(ready->step.odom_from_robot, IsNear(Se2::from_xy_yaw(0.05, 0.0, 0.0), 1e-9));
  EXPECT_EQ(ready->arrived_s, 1.025);
}

TEST_F(IntakeTest, TakesOlderOdometryWhereNewerDoesNotCome) {
  take(odometry(1.0, 0.3));
  take(scan_message(1.5));
  intake_.wait_until(1.515);
  EXPECT_FALSE(intake_.next_ready());
  intake_.wait_until(1.53);
  const std::optional<ReadyScan> ready = intake_.next_ready();
  ASSERT_TRUE(ready);
  EXPECT_THAT(ready->step.odom_from_robot, IsNear(Se2::from_xy_yaw(0.3, 0.0, 0.0), 1e-12));
  EXPECT_EQ(intake_.counts().odometry_held, 1U);
}

TEST_F(IntakeTest, RefusesAScanWithoutOdometryNearIt) {
  take(odometry(1.0, 0.3));
  take(scan_message(2.5));
  take(scan_message(2.6));
  intake_.end();
  EXPECT_FALSE(intake_.next_ready());
  EXPECT_EQ(intake_.next_refused()->why, Refusal::NoOdometry);
  EXPECT_EQ(intake_.counts().scans_without_odometry, 2U);
}

TEST_F(IntakeTest, RefusesDuplicatesAndWhatCameTooLate) {
  take(both(1.0, 0.0));
  take(both(1.0, 0.0));
  take(both(0.9, 0.0));
  EXPECT_EQ(intake_.next_refused()->why, Refusal::Duplicate);
  EXPECT_EQ(intake_.next_refused()->why, Refusal::OutOfOrder);
  take(odometry(0.9, 0.0));
  take(odometry(0.8, 0.0));
  EXPECT_EQ(intake_.counts().odometry_out_of_order, 1U);
}

TEST_F(IntakeTest, TakesJumpsOutOfTheOdometry) {
  take(both(1.0, 5.0));
  take(both(1.1, 5.1));
  take(both(1.2, 0.0));  // the robot's odometry begins anew
  take(both(1.3, 0.1));
  std::vector<ReadyScan> ready;
  while (std::optional<ReadyScan> next = intake_.next_ready()) {
    ready.push_back(*next);
  }
  ASSERT_EQ(ready.size(), 4U);
  EXPECT_FALSE(ready[1].unmeasured_s);
  ASSERT_TRUE(ready[2].unmeasured_s);
  EXPECT_NEAR(*ready[2].unmeasured_s, 0.1, 1e-9);
  EXPECT_FALSE(ready[3].unmeasured_s);
  EXPECT_THAT(ready[2].step.odom_from_robot, IsNear(Se2::from_xy_yaw(5.1, 0.0, 0.0), 1e-9));
  EXPECT_THAT(ready[3].step.odom_from_robot, IsNear(Se2::from_xy_yaw(5.2, 0.0, 0.0), 1e-9));
  EXPECT_EQ(intake_.counts().odometry_jumps, 1U);
}

TEST_F(IntakeTest, SeesThatOdometryBeganAnewAfterAGap) {
  take(both(1.0, 5.0));
  take(both(61.0, 0.0));  // slow enough to have been driven in a minute
  intake_.next_ready();
  EXPECT_NEAR(*intake_.next_ready()->unmeasured_s, 60.0, 1e-9);
  take(both(121.0, 20.0));
  EXPECT_FALSE(intake_.next_ready()->unmeasured_s) << "a gap, but the wheels went on counting";
}

TEST_F(IntakeTest, GoesOnWhereTheClockIsSetBack) {
  take(both(100.0, 1.0), 100.0);
  for (int i = 0; i < 6; ++i) {
    take(both(10.0 + 0.1 * i, 1.1 + 0.1 * i), 100.1 + 0.1 * i);
  }
  int ready = 0;
  while (std::optional<ReadyScan> next = intake_.next_ready()) {
    EXPECT_FALSE(next->unmeasured_s);
    ++ready;
  }
  EXPECT_EQ(ready, 5) << "two are left out until it is sure";
  EXPECT_EQ(intake_.counts().clock_set_back, 1U);
}

TEST_F(IntakeTest, GoesOnWhereTheClockIsSetBackUnderOdometryAlone) {
  take(odometry(100.0, 1.0), 100.0);
  take(scan_message(100.0), 100.0);
  for (int i = 0; i < 6; ++i) {
    take(odometry(10.0 + 0.1 * i, 1.1), 100.1 + 0.1 * i);
    take(scan_message(10.0 + 0.1 * i), 100.1 + 0.1 * i);
  }
  intake_.end();
  int ready = 0;
  while (intake_.next_ready()) {
    ++ready;
  }
  EXPECT_EQ(ready, 5);
}

TEST_F(IntakeTest, CountsWhatIsOdd) {
  take(both(1.0, 0.0));
  Message other = both(1.1, 0.0);
  other.scan = scan_at(1.1, 5);
  take(other);
  Message blind = both(5.0, 0.0);
  blind.scan->ranges_m.assign(3, std::numeric_limits<float>::quiet_NaN());
  take(blind);
  EXPECT_EQ(intake_.counts().beam_count_changes, 2U);
  EXPECT_EQ(intake_.counts().blind_scans, 1U);
  EXPECT_EQ(intake_.counts().gaps, 1U);
  EXPECT_EQ(intake_.counts().scans, 3U);
}

TEST_F(IntakeTest, KeepsBoundedMemoryWhateverComes) {
  for (int i = 0; i < 20000; ++i) {
    take(odometry(1.0 + 1e-5 * i, 0.0), 1.0);
    take(scan_message(100.0 + i), 1.0);
  }
  int refused = 0;
  while (intake_.next_refused()) {
    ++refused;
  }
  EXPECT_GE(refused, 18000);
}

TEST_F(IntakeTest, RemembersTheLastOdometryInAState) {
  take(both(1.0, 5.0));
  StateWriter writer;
  intake_.save(writer);
  Intake resumed{IntakeParams{}};
  StateReader reader(writer.bytes());
  resumed.load(reader);
  EXPECT_TRUE(reader.at_end());
  resumed.take(both(1.0, 5.0), 0.0);
  EXPECT_EQ(resumed.next_refused()->why, Refusal::Duplicate);
  resumed.take(both(2.0, 0.0), 0.0);
  EXPECT_TRUE(resumed.next_ready()->unmeasured_s) << "it jumped";
}

}  // namespace
}  // namespace sketchloc

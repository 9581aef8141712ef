#include <numbers>

#include "datasets/io/corrected_poses.hpp"
#include "datasets/io/run_io.hpp"
#include "tests/datasets/io/files.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using testing::FailsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::IsNear;

constexpr double kHalfTurn = std::numbers::pi;

class Carmen : public testing::FileTest {
 protected:
  auto reading(std::string_view content, const RunReading& options = {}) const {
    const std::filesystem::path log = file("run.log", content);
    return [log, options] { read_carmen(log, options); };
  }
  RunFile read(std::string_view content, const RunReading& options = {}) const {
    return read_carmen(file("run.log", content), options);
  }
};

constexpr const char* kFrontLaser = "FLASER 3 1 2.5 81.83 9 9 9 0.1 -0.2 0.3 10.5 robot 1.5\n";
constexpr const char* kRobotLaser =
    "ROBOTLASER1 0 -1.5 3.1 0.5 50 0.1 0 3 1 2 3 2 7 8 1 2 0 0.9 2 0 0 0 0 0 0 10.5 robot 1.5\n";

TEST_F(Carmen, TakesTheOdometryOfAFrontLaserLineNotItsCorrectedPose) {
  const RunFile file = read(kFrontLaser);
  ASSERT_EQ(file.run.steps.size(), 1U);
  EXPECT_THAT(file.run.steps[0].odom_from_robot, IsNear(Se2::from_xy_yaw(0.1, -0.2, 0.3), 1e-12));
  EXPECT_THAT(file.run.steps[0].scan.robot_from_laser, IsNear(Se2(), 0.0));
  EXPECT_EQ(file.run.steps[0].scan.time_s, 10.5);
  EXPECT_THAT(file.run.steps[0].scan.ranges_m, ElementsAre(1.0F, 2.5F, 81.83F));
  EXPECT_THAT(file.notes, IsEmpty());
}

TEST_F(Carmen, SpreadsAnOddCountOverBothEndsOfTheHalfCircle) {
  const Scan scan = read("FLASER 3 1 1 1 0 0 0 0 0 0 1 h 1\n").run.steps[0].scan;
  EXPECT_DOUBLE_EQ(scan.angle_rad(0), -kHalfTurn / 2);
  EXPECT_DOUBLE_EQ(scan.angle_rad(2), kHalfTurn / 2);
}

TEST_F(Carmen, LeavesOutTheLeftEndForAnEvenCount) {
  const Scan scan = read("FLASER 4 1 1 1 1 0 0 0 0 0 0 1 h 1\n").run.steps[0].scan;
  EXPECT_DOUBLE_EQ(scan.angle_rad(0), -kHalfTurn / 2);
  EXPECT_DOUBLE_EQ(scan.angle_rad(3), kHalfTurn / 4);
}

TEST_F(Carmen, ReadsAScanOfOneBeam) {
  EXPECT_EQ(read("FLASER 1 1 0 0 0 0 0 0 1 h 1\n").run.steps[0].scan.ranges_m.size(), 1U);
}

TEST_F(Carmen, TreatsTheSickSentinelAsNoReturn) {
  const Scan scan = read(kFrontLaser).run.steps[0].scan;
  EXPECT_EQ(scan.max_range_m, 80.0);
  EXPECT_TRUE(scan.is_return(1));
  EXPECT_FALSE(scan.is_return(2));
}

TEST_F(Carmen, TakesTheMaximumRangeFromTheParametersUnlessToldOtherwise) {
  const std::string log = std::string("PARAM robot_front_laser_max 49.5 host 0\n") + kFrontLaser;
  EXPECT_EQ(read(log).run.steps[0].scan.max_range_m, 49.5);
  EXPECT_EQ(read(log, {.max_range_m = 2.0}).run.steps[0].scan.max_range_m, 2.0);
}

TEST_F(Carmen, ReadsTheGeometryOfARobotLaserLine) {
  const RunFile file = read(kRobotLaser);
  const RunStep& step = file.run.steps.at(0);
  EXPECT_EQ(step.scan.first_angle_rad, -1.5);
  EXPECT_EQ(step.scan.angle_step_rad, 0.5);
  EXPECT_EQ(step.scan.max_range_m, 50.0);
  EXPECT_THAT(step.scan.ranges_m, ElementsAre(1.0F, 2.0F, 3.0F));
  EXPECT_THAT(step.odom_from_robot, IsNear(Se2::from_xy_yaw(0.9, 2, 0), 1e-12));
  EXPECT_THAT(step.scan.robot_from_laser, IsNear(Se2::from_xy_yaw(0.1, 0, 0), 1e-12));
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("which a mapper may have corrected")));
}

TEST_F(Carmen, InterpolatesTheOdometryOfARobotLaserLineBetweenOdomLines) {
  const RunFile file =
      read(std::string("ODOM 0 0 0 0 0 0 10 h 1\n") + kRobotLaser + "ODOM 4 0 0 0 0 0 11 h 1\n");
  EXPECT_THAT(file.run.steps.at(0).odom_from_robot, IsNear(Se2::from_xy_yaw(2, 0, 0), 1e-12));
}

TEST_F(Carmen, RefusesARobotLaserLineFarFromAllOdomLines) {
  EXPECT_THAT(reading(std::string(kRobotLaser) + "ODOM 4 0 0 0 0 0 20 h 1\n"),
              FailsWith("run.log:1: time: expected a time covered by the ODOM lines"));
}

TEST_F(Carmen, ReadsOnlyTheFrontLaserWhereBothKindsAreLogged) {
  const RunFile file = read(std::string(kRobotLaser) + kFrontLaser);
  EXPECT_EQ(file.run.steps.size(), 1U);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("only FLASER is read")));
}

TEST_F(Carmen, PassesOverOtherLines) {
  const RunFile file = read(std::string("# comment\n\nVERTEX2 0 1 2 3\nEDGE2 0 1\nNEFF 3\n") +
                            "PARAM robot_use_laser on nohost 0\n" + kFrontLaser);
  EXPECT_EQ(file.run.steps.size(), 1U);
}

TEST_F(Carmen, ReadsWindowsLineEndsAndPlusSigns) {
  EXPECT_EQ(read("FLASER 1 +1.5 0 0 0 0 0 0 +1 h 1\r\n").run.steps[0].scan.ranges_m[0], 1.5F);
}

TEST_F(Carmen, NamesFileLineFieldAndWhatItFound) {
  EXPECT_THAT(reading("# one\nFLASER 3 1 x 3 0 0 0 0 0 0 1 h 1\n"),
              FailsWith("run.log:2: range 1: expected a number from -1e+06 to 1e+06, found \"x\""));
  EXPECT_THAT(reading("FLASER 1 1 0 0 0 nan 0 0 1 h 1\n"),
              FailsWith("run.log:1: odom_x: expected a number"));
  EXPECT_THAT(reading("FLASER 1 1 0 0 0 0 inf 0 1 h 1\n"), FailsWith("odom_y: expected a number"));
  EXPECT_THAT(reading("FLASER 1 1 0 0 0 0 0 1e300 1 h 1\n"), FailsWith("odom_theta: expected"));
  EXPECT_THAT(reading("FLASER 1 1e999 0 0 0 0 0 0 1 h 1\n"), FailsWith("range 0: expected"));
  EXPECT_THAT(reading("FLASER 1 1 0 0 0 0 0 0 1 h 1 2\n"),
              FailsWith("columns: expected the end of the line, found \"2\""));
}

TEST_F(Carmen, NamesTheScanWhoseTimeGoesBack) {
  EXPECT_THAT(reading("FLASER 1 1 0 0 0 0 0 0 5 h 1\nFLASER 1 1 0 0 0 0 0 0 4 h 1\n"),
              FailsWith("run.log:2: time: expected at least the 5.000000 s"));
}

TEST_F(Carmen, GivesTheFirstCorrectedPoseOfEachTime) {
  const std::string scans =
      "FLASER 1 1 1 2 0 0 0 0 5 h 1\nFLASER 1 1 3 4 0 0 0 0 5 h 1\nFLASER 1 1 5 6 0 0 0 0 6 h 1\n";
  const MetricTrajectory corrected = read_corrected_poses(file("run.log", scans));
  ASSERT_EQ(corrected.size(), 2U);
  EXPECT_EQ(corrected[0].pose.x_m(), 1.0);
  EXPECT_EQ(corrected[1].pose.x_m(), 5.0);
  EXPECT_EQ(read(scans).run.steps.size(), 3U);  // the same rule: times must not decrease
  const std::filesystem::path back = file("back.log", scans + "FLASER 1 1 5 6 0 0 0 0 5.5 h 1\n");
  EXPECT_THAT([&] { read_corrected_poses(back); },
              FailsWith("back.log:4: time: expected at least 6, as of the scan before, found 5.5"));
}

TEST_F(Carmen, RefusesACountThatIsNotThere) {
  EXPECT_THAT(
      reading("FLASER 1000000000 1 2 3\n"),
      FailsWith("num_readings: expected an integer from 1 to 100000, found \"1000000000\""));
  EXPECT_THAT(reading("FLASER -1 1 2 3\n"), FailsWith("num_readings: expected an integer"));
  EXPECT_THAT(reading("FLASER 5 1 2 3\n"), FailsWith("ranges: expected 5 values, found 3"));
  EXPECT_THAT(reading("FLASER\n"), FailsWith("num_readings: expected a value, found the end"));
}

TEST_F(Carmen, RefusesALogWithoutScans) {
  EXPECT_THAT(reading(""), FailsWith("run.log: scans: expected lines that start with FLASER"));
  EXPECT_THAT(reading("ODOM 0 0 0 0 0 0 10 h 1\n"), FailsWith("scans: expected lines"));
}

}  // namespace
}  // namespace sketchloc

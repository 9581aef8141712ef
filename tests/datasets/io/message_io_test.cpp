#include "datasets/io/message_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "datasets/io/run_io.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;

constexpr const char* kScan =
    R"("scan": {"first_angle_rad": -1, "angle_step_rad": 0.5, "max_range_m": 30, "ranges_m": )";

ReadMessage parse(const std::string& line) { return parse_json_message(line, "robot", 7); }

std::string complaint_about(const std::string& line) {
  try {
    parse(line);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(MessageIo, ReadsAStepOfALog) {
  RunStep step{.scan = {.time_s = 2.5,
                        .first_angle_rad = -1.0,
                        .angle_step_rad = 0.5,
                        .max_range_m = 30.0,
                        .robot_from_laser = {},
                        .ranges_m = {1.0F, 2.0F}},
               .odom_from_robot = Se2::from_xy_yaw(1.0, 2.0, 0.5)};
  const ReadMessage read = parse(json_line(step));
  EXPECT_EQ(read.message.time_s, 2.5);
  ASSERT_TRUE(read.message.odom_from_robot && read.message.scan);
  EXPECT_EQ(read.message.odom_from_robot->x_m(), 1.0);
  EXPECT_EQ(read.message.scan->time_s, 2.5);
  EXPECT_EQ(read.message.scan->ranges_m, step.scan.ranges_m);
  EXPECT_FALSE(read.had_nan);
}

TEST(MessageIo, ReadsOdometryAndScansAlone) {
  const ReadMessage odometry =
      parse(R"({"time_s": 1, "odometry": {"x_m": 1, "y_m": 2, "yaw_rad": 3}})");
  EXPECT_TRUE(odometry.message.odom_from_robot);
  EXPECT_FALSE(odometry.message.scan);
  const ReadMessage scan = parse(std::string(R"({"time_s": 1, )") + kScan + "[1, null]}}");
  EXPECT_FALSE(scan.message.odom_from_robot);
  EXPECT_EQ(scan.message.scan->ranges_m.size(), 2U);
}

TEST(MessageIo, TakesNanAndInfinityForNull) {
  const ReadMessage read =
      parse(std::string(R"({"time_s": 1, )") + kScan + "[1, NaN, nan, Infinity, -Infinity, 2]}}");
  EXPECT_TRUE(read.had_nan);
  ASSERT_EQ(read.message.scan->ranges_m.size(), 6U);
  for (const std::size_t beam : {1U, 2U, 3U, 4U}) {
    EXPECT_TRUE(std::isnan(read.message.scan->ranges_m[beam]));
  }
  EXPECT_EQ(read.message.scan->ranges_m[5], 2.0F);
  EXPECT_THAT(complaint_about(R"({"time_s": 1, "odometry": {"x_m": NaN, "y_m": 2, "yaw_rad": 3}})"),
              HasSubstr("robot:7: odometry.x_m: expected a number"));
}

TEST(MessageIo, SaysWhatIsWrong) {
  EXPECT_THAT(complaint_about(R"({"time_s": 1})"),
              HasSubstr(R"(a message needs "odometry", "scan" or both)"));
  EXPECT_THAT(complaint_about("hello"), HasSubstr("robot:7: JSON"));
  EXPECT_THAT(complaint_about("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(complaint_about(R"({"odometry": {"x_m": 1, "y_m": 2, "yaw_rad": 3}})"),
              HasSubstr("time_s"));
  EXPECT_THAT(complaint_about(R"({"time_s": 1e300, "odometry": {}})"), HasSubstr("time_s"));
  EXPECT_THAT(complaint_about(R"({"time_s": 1, "nan": 2, "odometry": {}})"),
              HasSubstr("unknown field"));
  EXPECT_THAT(complaint_about(std::string(R"({"time_s": 1, )") + kScan + "[]}}"),
              HasSubstr("scan.ranges_m"));
}

}  // namespace
}  // namespace sketchloc

#include <cmath>
#include <limits>

#include "datasets/io/run_io.hpp"
#include "tests/datasets/io/files.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::content_of;
using ::testing::ElementsAre;
using testing::FailsWith;
using testing::IsNear;

constexpr const char* kLine =
    R"({"time_s":2.5,"odometry":{"x_m":1,"y_m":-2,"yaw_rad":0.5},"scan":{"first_angle_rad":-1,)"
    R"("angle_step_rad":0.1,"max_range_m":30,"ranges_m":[1.25,null,3]}})";

class JsonLines : public testing::FileTest {
 protected:
  auto reading(std::string_view content) const {
    const std::filesystem::path log = file("run.jsonl", content);
    return [log] { read_jsonl(log); };
  }
  /// kLine with one piece replaced.
  static std::string line_with(std::string_view piece, std::string_view replacement) {
    std::string line = kLine;
    return line.replace(line.find(piece), piece.size(), replacement) + "\n";
  }
};

TEST_F(JsonLines, ReadsOneStepPerLine) {
  const RunFile file = read_jsonl(this->file("run.jsonl", std::string(kLine) + "\n\n" + kLine));
  ASSERT_EQ(file.run.steps.size(), 2U);
  const RunStep& step = file.run.steps[0];
  EXPECT_EQ(step.scan.time_s, 2.5);
  EXPECT_THAT(step.odom_from_robot, IsNear(Se2::from_xy_yaw(1, -2, 0.5), 1e-12));
  EXPECT_EQ(step.scan.ranges_m.size(), 3U);
  EXPECT_TRUE(step.scan.is_return(0));
  EXPECT_FALSE(step.scan.is_return(1));
  EXPECT_THAT(step.scan.robot_from_laser, IsNear(Se2(), 0.0));
}

TEST_F(JsonLines, GiveBackWhatWasWritten) {
  sketchloc::Run run;
  RunStep step{.scan = {.time_s = 976052890.244111,
                        .first_angle_rad = -1.5707963267948966,
                        .angle_step_rad = 0.017453292519943295,
                        .min_range_m = 0.05,
                        .max_range_m = 80.0,
                        .robot_from_laser = Se2::from_xy_yaw(0.1, 0.0, -0.2),
                        .ranges_m = {1.0F / 3.0F, std::nanf(""), 81.83F}},
               .odom_from_robot = Se2::from_xy_yaw(1e-17, 5e6, 3.0)};
  run.steps = {step, step};
  write_jsonl(missing("run.jsonl"), run);
  const RunFile back = read_run_file(missing("run.jsonl"));
  ASSERT_EQ(back.run.steps.size(), 2U);
  const RunStep& read = back.run.steps[1];
  EXPECT_EQ(read.scan.time_s, step.scan.time_s);
  EXPECT_EQ(read.scan.first_angle_rad, step.scan.first_angle_rad);
  EXPECT_EQ(read.scan.angle_step_rad, step.scan.angle_step_rad);
  EXPECT_EQ(read.scan.min_range_m, step.scan.min_range_m);
  EXPECT_THAT(read.scan.ranges_m, ElementsAre(1.0F / 3.0F, ::testing::IsNan(), 81.83F));
  EXPECT_THAT(read.odom_from_robot, IsNear(step.odom_from_robot, 1e-15));
  EXPECT_THAT(read.scan.robot_from_laser, IsNear(step.scan.robot_from_laser, 1e-15));
}

TEST_F(JsonLines, WriteTheSameBytesForWhatTheyRead) {
  const RunFile first = read_jsonl(file("run.jsonl", kLine));
  write_jsonl(missing("second.jsonl"), first.run);
  write_jsonl(missing("third.jsonl"), read_jsonl(missing("second.jsonl")).run);
  EXPECT_EQ(content_of(missing("second.jsonl")), content_of(missing("third.jsonl")));
}

TEST_F(JsonLines, NameTheFieldThatIsMissingWrongOrUnknown) {
  EXPECT_THAT(reading(line_with("\"odometry\"", "\"odometrie\"")),
              FailsWith("run.jsonl:1: unknown field \"odometrie\""));
  EXPECT_THAT(reading(R"({"time_s":1,"scan":{}})"), FailsWith("run.jsonl:1: no \"odometry\""));
  EXPECT_THAT(reading(line_with("-2", "\"west\"")),
              FailsWith("odometry.y_m: expected a number from -1e+09 to 1e+09, found the string"));
  EXPECT_THAT(reading(line_with("null", "true")), FailsWith("scan.ranges_m[1]: expected a number"));
  EXPECT_THAT(reading(line_with("[1.25,null,3]", "7")),
              FailsWith("scan.ranges_m: expected an array, found 7"));
  EXPECT_THAT(reading(line_with("[1.25,null,3]", "[]")), FailsWith("expected 1 to 100000 values"));
  EXPECT_THAT(reading(line_with("30", "-1")), FailsWith("expected 0 <= min_range_m < max_range_m"));
}

TEST_F(JsonLines, RefuseWhatIsNotJson) {
  EXPECT_THAT(reading("hello\n"), FailsWith("run.jsonl:1: JSON: it stops making sense at byte 1"));
  EXPECT_THAT(reading("[1, 2]\n"), FailsWith("line: expected an object, found an array"));
  EXPECT_THAT(reading(line_with("-2", "NaN")), FailsWith("NaN is no JSON; use null"));
  EXPECT_THAT(reading(line_with("-2", "1e999")), FailsWith("run.jsonl:1: JSON:"));
  EXPECT_THAT(reading(line_with("-2", std::string(100'000, '['))), FailsWith("levels of nesting"));
  EXPECT_THAT(reading("\n\n"), FailsWith("steps: expected one JSON object per line, found none"));
}

TEST_F(JsonLines, AreParsedOneByOneForAnOnlineLoop) {
  EXPECT_EQ(parse_json_step(kLine, "stdin", 7).scan.time_s, 2.5);
  EXPECT_THAT([] { parse_json_step("{}", "stdin", 7); }, FailsWith("stdin:7: no \"odometry\""));
}

TEST_F(JsonLines, CannotSayAPoseThatIsNotFinite) {
  RunStep step;
  step.scan.time_s = std::numeric_limits<double>::infinity();
  EXPECT_THROW(json_line(step), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::CommandResult;
using testing::content_of;
using ::testing::HasSubstr;

class PlanEndToEnd : public ::testing::Test {
 protected:
  CommandResult plan(const std::string& start, const std::string& goal,
                     const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM,
                                        "plan",
                                        "--map",
                                        SKETCHLOC_SAMPLES "/office/drawing.png",
                                        "--start",
                                        start,
                                        "--goal",
                                        goal,
                                        "--deadline-ms",
                                        "0",
                                        "--planning.improvements",
                                        "2000",
                                        "--out",
                                        folder_ / "out",
                                        "--force"};
    command.insert(command.end(), flags.begin(), flags.end());
    return testing::run_command(command);
  }
  nlohmann::json metrics() const {
    return nlohmann::json::parse(content_of(folder_ / "out/metrics.json"));
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(PlanEndToEnd, FindsTheWayFromRoomToRoom) {
  const CommandResult result = plan("145,285,0,17.3", "437,272");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(metrics()["status"], "found");
  EXPECT_GE(metrics()["least_clearance_m"], metrics()["kept_clear_m"]);
  EXPECT_GT(metrics()["length_m"], 17.0);
  EXPECT_THAT(content_of(folder_ / "out/path.csv"), HasSubstr("x_px,y_px,way_m,clearance_m"));
  EXPECT_THAT(content_of(folder_ / "out/report.html"), HasSubstr("Better and better"));
  EXPECT_THAT(content_of(folder_ / "out/picture.png"), HasSubstr("PNG"));
}

TEST_F(PlanEndToEnd, GivesTheSameWayForTheSameSeed) {
  ASSERT_EQ(plan("145,285,0,17.3", "437,272").exit_code, 0);
  const std::string first = content_of(folder_ / "out/path.csv");
  ASSERT_EQ(plan("145,285,0,17.3", "437,272").exit_code, 0);
  EXPECT_EQ(content_of(folder_ / "out/path.csv"), first);
}

TEST_F(PlanEndToEnd, SaysWhereTheRobotFits) {
  const CommandResult result = plan("469.8,161.3,0,17.3", "437,272");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("start blocked"));
  EXPECT_THAT(result.err, HasSubstr("--start 466"));
  EXPECT_FALSE(metrics()["nearest_free_px"].is_null());
}

TEST_F(PlanEndToEnd, WantsToKnowTheScale) {
  const CommandResult result = plan("145,285", "437,272");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("PX_PER_M"));
}

TEST_F(PlanEndToEnd, KeepsToATurningRadiusOrSaysThatItCannot) {
  EXPECT_EQ(plan("145,285,180,17.3", "437,272,180", {"--planning.turning_radius_m", "1"}).exit_code,
            0);
  EXPECT_THAT(content_of(folder_ / "out/metrics.json"), HasSubstr("\"source\": \"turning\""));
  const CommandResult tight =
      plan("145,285,180,17.3", "437,272", {"--planning.turning_radius_m", "5"});
  EXPECT_EQ(tight.exit_code, 1);
  EXPECT_THAT(tight.err, HasSubstr("too tight to turn"));
  EXPECT_THAT(tight.err, HasSubstr("--planning.turning_radius_m"));
}

TEST_F(PlanEndToEnd, CrossesShutDoorsWhereAllowed) {
  const std::vector<std::string> huge = {"--planning.body.radius_m", "0.9"};
  EXPECT_EQ(plan("145,285,0,17.3", "437,272", huge).exit_code, 1);
  EXPECT_EQ(metrics()["status"], "no path");
  ASSERT_EQ(
      plan("145,285,0,17.3", "437,272", {huge[0], huge[1], "--planning.crossing_cost_m", "10"})
          .exit_code,
      0);
  EXPECT_EQ(metrics()["status"], "found across strokes");
}

}  // namespace
}  // namespace sketchloc

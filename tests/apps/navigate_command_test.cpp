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

class NavigateEndToEnd : public ::testing::Test {
 protected:
  CommandResult run(std::vector<std::string> command, const std::vector<std::string>& more) const {
    command.insert(command.begin(), SKETCHLOC_PROGRAM);
    command.insert(command.end(), {"--out", folder_ / "out", "--force"});
    command.insert(command.end(), more.begin(), more.end());
    return testing::run_command(command);
  }
  CommandResult navigate(const std::vector<std::string>& more = {}) const {
    return run({"navigate", "--seed", "500", "--navigation.most_cycles", "3"}, more);
  }
  CommandResult suite(const std::string& name, const std::vector<std::string>& more) const {
    return run({"ablate", "--suite", name, "--seed", "500"}, more);
  }
  nlohmann::json metrics() const {
    return nlohmann::json::parse(content_of(folder_ / "out/metrics.json"));
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(NavigateEndToEnd, DrivesAndKeepsWhatHappened) {
  const CommandResult result = navigate({"--plan", "4", "--method", "mcl"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("failure: "));
  EXPECT_EQ(metrics()["rows"][0]["trials"], 1);
  const auto drive = nlohmann::json::parse(content_of(folder_ / "out/drive.json"));
  EXPECT_EQ(drive["frames"].size(), 3U);
  EXPECT_EQ(drive["end"], "too long");
  EXPECT_THAT(content_of(folder_ / "out/picture.png"), HasSubstr("PNG"));
  EXPECT_THAT(content_of(folder_ / "out/report.html"), HasSubstr("id=\"player\""));
}

TEST_F(NavigateEndToEnd, NamesTheOptionThatMakesNoSense) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--plan", "-1"},
      {"--person", "dog"},
      {"--method", "odometry"},
      {"--method", "dog"},
      {"--seed", "-3"},
      {"--navigation.planning.turning_radius_m", "0.5"},
      {"--navigation.replan_m", "0"},
      {"--navigation.off_way_m", "-1"},
      {"--navigation.goal_looks", "0"},
      {"--navigation.task.most_way_m", "1"},
      {"--navigation.start.position_m", "-1"}};
  for (const std::vector<std::string>& flags : wrong) {
    const CommandResult result = navigate(flags);
    EXPECT_NE(result.exit_code, 0) << flags[0];
    EXPECT_THAT(result.err, HasSubstr(flags[0].substr(2))) << flags[0];
  }
}

TEST_F(NavigateEndToEnd, ASuiteOfDrivesIsATableOfRates) {
  const CommandResult result =
      suite("navigation", {"--methods", "mcl", "--navigation_suite.plans", "2",
                           "--navigation_suite.tps_plans", "1", "--navigation.most_cycles", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| human | mcl | 0/2 = 0 % ["));
  EXPECT_EQ(metrics()["rows"].size(), 2U);
  EXPECT_THAT(content_of(folder_ / "out/report.html"), HasSubstr("Ablation: navigation"));
  EXPECT_THAT(content_of(folder_ / "out/report.html"),
              HasSubstr("sketchloc navigate --person human --plan 1 --method mcl --seed 500"));
}

TEST_F(NavigateEndToEnd, ASuiteOfPlansIsATableToo) {
  const CommandResult result =
      suite("planning", {"--planning_suite.drawings", "1", "--planning_suite.queries", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(content_of(folder_ / "out/report.html"), HasSubstr("planning"));
}

}  // namespace
}  // namespace sketchloc

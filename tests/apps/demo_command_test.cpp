#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::CommandResult;
using testing::TemporaryDirectory;

TEST(DemoCommandEndToEnd, FindsTheRobotToTheEndAndReplacesAnEarlierResult) {
  const TemporaryDirectory folder;
  const std::filesystem::path out = folder / "demo";
  std::filesystem::create_directory(out);
  std::ofstream(out / "run.yaml") << "a folder with this file is a result\n";
  std::ofstream(out / "earlier.txt") << "goes\n";
  const CommandResult demo =
      testing::run_command({SKETCHLOC_PROGRAM, "demo", "--out", out.string()});
  ASSERT_EQ(demo.exit_code, 0) << demo.err;
  EXPECT_FALSE(std::filesystem::exists(out / "earlier.txt"));
  const auto metrics = nlohmann::json::parse(std::ifstream(out / "metrics.json"));
  EXPECT_FALSE(metrics["lost_at_end"]);
  EXPECT_GT(metrics["share_within_2_m"], 0.9);
  EXPECT_TRUE(std::filesystem::exists(out / "report.html"));
}

}  // namespace
}  // namespace sketchloc

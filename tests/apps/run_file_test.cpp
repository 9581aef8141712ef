#include "apps/run_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "apps/version.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;

RunDescription description() {
  RunDescription run;
  run.command = "localize";
  run.seed = 7;
  run.inputs = {{"map", "a: b.png"}};
  run.parameters.child("particles").text = "2000";
  return run;
}

TEST(RunFile, SaysWhatMadeTheResult) {
  const std::string text = run_file_text(description());
  EXPECT_THAT(text, HasSubstr("commit: " + std::string(commit())));
  EXPECT_THAT(text, HasSubstr("command: localize"));
  EXPECT_THAT(text, HasSubstr("seed: 7"));
  EXPECT_THAT(text, HasSubstr("map: \"a: b.png\""));
}

TEST(RunFile, IsAConfigurationForTheNextRun) {
  const testing::TemporaryDirectory folder;
  std::ofstream(folder / "run.yaml") << run_file_text(description());
  const ConfigNode parameters = read_config(folder / "run.yaml");
  ASSERT_NE(parameters.find("particles"), nullptr);
  EXPECT_EQ(parameters.find("particles")->text, "2000");
}

}  // namespace
}  // namespace sketchloc

#include "apps/run_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "apps/version.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

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

TEST(RunFile, IsReadBackWithOptionsGivenSeveralTimes) {
  const testing::TemporaryDirectory folder;
  RunDescription run = description();
  run.drawing = {.width_px = 80, .height_px = 60};
  run.inputs = {{"map", "a: b.png"}, {"start", "1,2,3"},         {"alternative", "one.csv"},
                {"global", "true"},  {"alternative", "two.csv"}, {"title", "12"}};
  std::ofstream(folder / "run.yaml") << run_file_text(run);
  const std::optional<RunDescription> read = read_run_description(folder / "run.yaml");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->drawing, run.drawing);
  EXPECT_EQ(read->command, "localize");
  EXPECT_THAT(read->inputs,
              ElementsAre(Pair("seed", "7"), Pair("map", "a: b.png"), Pair("start", "1,2,3"),
                          Pair("alternative", "one.csv"), Pair("alternative", "two.csv"),
                          Pair("global", "true"), Pair("title", "12")));
  EXPECT_EQ(read_config(folder / "run.yaml").find("particles")->text, "2000");
}

TEST(RunFile, IsNoOtherFile) {
  const testing::TemporaryDirectory folder;
  std::ofstream(folder / "tune.yaml") << "particles: 7\n";
  EXPECT_FALSE(read_run_description(folder / "tune.yaml"));
  EXPECT_FALSE(read_run_description(folder / "none.yaml"));
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

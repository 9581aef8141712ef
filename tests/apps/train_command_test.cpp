#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::CommandResult;
using testing::content_of;
using ::testing::HasSubstr;

class TrainEndToEnd : public ::testing::Test {
 protected:
  CommandResult train(const std::string& out, const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM, "train", "--out", folder_ / out};
    for (const char* flag :
         {"--network=ours", "--samples=64", "--validate-every=16", "--validation-batches=1",
          "--threads=1", "--source.batch=8", "--source.scenes=2", "--source.sample.cells=32",
          "--source.scene.drive_m=10", "--source.scene.home_share=1",
          "--source.scene.office_share=0"}) {
      command.emplace_back(flag);
    }
    command.insert(command.end(), flags.begin(), flags.end());
    return testing::run_command(command);
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(TrainEndToEnd, GoesOnAsIfItHadNeverStopped) {
  const CommandResult whole = train("whole");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(train("parts", {"--stop-after=32"}).exit_code, 0);
  const CommandResult rest = train("parts", {"--resume"});
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("go on after 32 samples"));
  EXPECT_EQ(content_of(folder_ / "whole/network.onnx"), content_of(folder_ / "parts/network.onnx"));
  EXPECT_FALSE(content_of(folder_ / "whole/network.onnx").empty());
  EXPECT_THAT(content_of(folder_ / "whole/run.yaml"), HasSubstr("learning_rate"));
}

TEST_F(TrainEndToEnd, GoesOnAlikeWhileItImprovesItsPriors) {
  const std::string early = "--improve_after=16";
  ASSERT_EQ(train("whole", {early}).exit_code, 0);
  ASSERT_EQ(train("plain").exit_code, 0);
  EXPECT_EQ(train("parts", {early, "--stop-after=40"}).exit_code, 0);  // between two points
  EXPECT_EQ(train("parts", {early, "--resume"}).exit_code, 0);
  const std::string whole = content_of(folder_ / "whole/network.onnx");
  EXPECT_EQ(whole, content_of(folder_ / "parts/network.onnx"));
  EXPECT_NE(whole, content_of(folder_ / "plain/network.onnx"));
}

TEST_F(TrainEndToEnd, NeverOverwritesWithoutBeingAsked) {
  EXPECT_EQ(train("here", {"--stop-after=8"}).exit_code, 0);
  const CommandResult again = train("here");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--resume"));
}

}  // namespace
}  // namespace sketchloc

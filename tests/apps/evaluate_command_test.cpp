#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::CommandResult;
using ::testing::HasSubstr;
using testing::TemporaryDirectory;

/// Straight on for 3 m; the estimate lies 2 m beside it.
class EvaluateCommandEndToEnd : public ::testing::Test {
 protected:
  EvaluateCommandEndToEnd() {
    std::ofstream reference(folder_ / "reference.tum");
    std::ofstream estimate(folder_ / "estimate.tum");
    for (const char* x : {"0", "1", "2", "3"}) {
      reference << x << " " << x << " 0 0 0 0 0 1\n";
      estimate << x << " " << x << " 2 0 0 0 0 1\n";
    }
  }

  CommandResult evaluate(std::vector<std::string> more) const {
    more.insert(more.begin(), {SKETCHLOC_PROGRAM, "evaluate"});
    return testing::run_command(more);
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  TemporaryDirectory folder_;
};

TEST_F(EvaluateCommandEndToEnd, PrintsTheErrorsOfATrajectory) {
  const CommandResult result =
      evaluate({"--trajectory", file("estimate.tum"), "--reference", file("reference.tum")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("4 of 4 poses have a reference"));
  EXPECT_THAT(result.out, HasSubstr("ATE unaligned, m           2.000     2.000     2.000"));
  EXPECT_THAT(result.out, HasSubstr("ATE SE(2), m               0.000"));
}

TEST_F(EvaluateCommandEndToEnd, WritesTheFolderOfResults) {
  const CommandResult result = evaluate({"--trajectory", file("estimate.tum"), "--reference",
                                         file("reference.tum"), "--json", "--out", file("result")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\"unaligned\""));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "result/metrics.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "result/run.yaml"));
}

TEST_F(EvaluateCommandEndToEnd, SaysWhatIsWrong) {
  EXPECT_EQ(evaluate({"--reference", file("reference.tum")}).exit_code, 2);
  EXPECT_EQ(evaluate({"--run", file("x"), "--reference", file("reference.tum")}).exit_code, 2);
  std::ofstream(folder_ / "later.tum") << "100 0 0 0 0 0 0 1\n";
  const CommandResult later =
      evaluate({"--trajectory", file("later.tum"), "--reference", file("reference.tum")});
  EXPECT_EQ(later.exit_code, 1);
  EXPECT_THAT(later.err, HasSubstr("--max-gap"));
}

}  // namespace
}  // namespace sketchloc

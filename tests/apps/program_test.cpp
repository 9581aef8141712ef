#include "apps/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/parameter_options.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct ToyParams {
  double share = 0.5;
};
template <typename Visitor>
void visit_fields(ToyParams& params, Visitor&& visit) {
  visit("share", params.share);
}

double seen_share = 0.0;
std::string seen_map;
std::string failure;

void work(const ParameterOptions& options) {
  seen_share = parameters_from<ToyParams>(options).share;
  if (failure == "data") {
    throw std::runtime_error("run.jsonl:1: no \"odometry\"");
  }
  if (failure == "usage") {
    throw std::invalid_argument("share must be in [0, 1], but it is 2");
  }
}

void add_toy_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("toy", "A command for the tests.");
  auto options = std::make_shared<ParameterOptions>();
  static bool force = false;
  command->add_option("--map", seen_map, "The drawing")->group(kAlgorithmGroup)->required();
  add_parameter_options(*command, to_config(ToyParams{}), *options);
  command->add_flag("--force", force, "Overwrite")->group(kOutputGroup);
  command->callback([options] { work(*options); });
}

struct Outcome {
  int exit_code = 0;
  std::string out;
  std::string err;
};

Outcome run(std::vector<const char*> arguments) {
  static constexpr std::array<AddCommand, 1> kCommands = {add_toy_command};
  arguments.insert(arguments.begin(), "sketchloc");
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const int code = run_program(static_cast<int>(arguments.size()), arguments.data(), kCommands);
  return {code, ::testing::internal::GetCapturedStdout(), ::testing::internal::GetCapturedStderr()};
}

class Program : public ::testing::Test {
 protected:
  void SetUp() override { failure.clear(); }
};

TEST_F(Program, GroupsItsHelpByAlgorithmOutputAndUsability) {
  const Outcome help = run({"toy", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  const std::size_t algorithm = help.out.find("Algorithm:");
  const std::size_t output = help.out.find("Output:");
  const std::size_t usability = help.out.find("Usability:");
  EXPECT_LT(algorithm, output);
  EXPECT_LT(output, usability);
  EXPECT_NE(usability, std::string::npos) << help.out;
  EXPECT_EQ(help.out.find("--share"), std::string::npos) << help.out;
}

TEST_F(Program, TakesFlagsOverTheFileOverTheDefaults) {
  const testing::TemporaryDirectory folder;
  const std::string config = (folder / "tune.yaml").string();
  std::ofstream(config) << "share: 0.25\n";
  EXPECT_EQ(run({"toy", "--map", "m"}).exit_code, 0);
  EXPECT_EQ(seen_share, 0.5);
  EXPECT_EQ(run({"toy", "--map", "m", "--config", config.c_str()}).exit_code, 0);
  EXPECT_EQ(seen_share, 0.25);
  run({"toy", "--map", "m", "--share", "0.75", "--config", config.c_str()});
  EXPECT_EQ(seen_share, 0.75);
}

TEST_F(Program, TakesTheOptionsOfAnEarlierRunWhereTheCommandLineSaysNothing) {
  const testing::TemporaryDirectory folder;
  const std::string earlier = (folder / "run.yaml").string();
  std::ofstream(earlier) << "sketchloc: {command: toy}\ninputs: {map: old}\n"
                         << "parameters: {share: 0.125}\n";
  EXPECT_EQ(run({"toy", "--config", earlier.c_str()}).exit_code, 0);
  EXPECT_EQ(seen_map, "old");
  EXPECT_EQ(seen_share, 0.125);
  EXPECT_EQ(run({"toy", ("--config=" + earlier).c_str(), "--map", "new"}).exit_code, 0);
  EXPECT_EQ(seen_map, "new");
}

TEST_F(Program, SaysWhichRecordedOptionItDoesNotKnow) {
  const testing::TemporaryDirectory folder;
  const std::string earlier = (folder / "run.yaml").string();
  std::ofstream(earlier) << "sketchloc: {command: toy}\ninputs: {colour: red}\nparameters: {}\n";
  const Outcome outcome = run({"toy", "--map", "m", "--config", earlier.c_str()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("sketchloc toy has no option --colour"));
}

TEST_F(Program, TakesOnlyTheParametersOfAnotherCommandsRun) {
  const testing::TemporaryDirectory folder;
  const std::string other = (folder / "run.yaml").string();
  std::ofstream(other) << "sketchloc: {command: other}\ninputs: {map: old}\n"
                       << "parameters: {share: 0.125}\n";
  EXPECT_THAT(run({"toy", "--config", other.c_str()}).err, HasSubstr("--map is required"));
  EXPECT_EQ(run({"toy", "--map", "m", "--config", other.c_str()}).exit_code, 0);
  EXPECT_EQ(seen_share, 0.125);
}

TEST_F(Program, PrintsAllParametersWithoutDoingAnything) {
  seen_share = -1.0;
  const Outcome outcome = run({"toy", "--print-parameters"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, StartsWith("share: 0.5\n"));
  EXPECT_EQ(seen_share, -1.0);
}

TEST_F(Program, EndsWithOneAndTheReasonWhereTheDataFail) {
  failure = "data";
  const Outcome outcome = run({"toy", "--map", "m"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "error: run.jsonl:1: no \"odometry\"\n");
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Program, EndsWithTwoWhereAParameterIsWrong) {
  failure = "usage";
  EXPECT_EQ(run({"toy", "--map", "m"}).exit_code, 2);
  failure.clear();
  const Outcome outcome = run({"toy", "--map", "m", "--share", "half"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "error: --share: share must be a number, but it is 'half'\n");
}

TEST_F(Program, EndsWithTwoAndAdviceOnAWrongCommandLine) {
  const Outcome missing = run({"toy"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("--map is required"));
  EXPECT_THAT(missing.err, HasSubstr("Run sketchloc toy --help"));
  EXPECT_THAT(run({"play"}).err, HasSubstr("unknown command play"));
  EXPECT_EQ(run({"play"}).exit_code, 2);
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"toy", "--map", "m", "--colour"}).exit_code, 2);
}

TEST(ProgramEndToEnd, SaysItsVersionAndCommit) {
  const testing::CommandResult result = testing::run_command({SKETCHLOC_PROGRAM, "--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, ::testing::MatchesRegex(
                              "sketchloc [0-9.]+ \\(commit ([0-9a-f]+(-dirty)?|unknown)\\)\n"));
}

TEST(ProgramEndToEnd, AsksForACommand) {
  const testing::CommandResult result = testing::run_command({SKETCHLOC_PROGRAM});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("--help"));
}

}  // namespace
}  // namespace sketchloc

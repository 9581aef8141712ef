#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_writer.hpp"
#include "datasets/sim/data_set.hpp"
#include "registration/network_output.hpp"
#include "tests/support/constant_network.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using testing::content_of;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using testing::TemporaryDirectory;

/// One building, one drawing, no sweeps; `ours` says that every prior is right.
class AblateCommandEndToEnd : public ::testing::Test {
 protected:
  AblateCommandEndToEnd() {
    const std::vector<float> nothing(ResidualOutput::kSize, 0.0F);
    std::ofstream(folder_ / "ours.onnx", std::ios::binary)
        << testing::constant_network(InputKind::Residual, nothing);
  }

  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  CommandResult run(const std::vector<std::string>& more, const std::string& out = "out") const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM,
                                        "ablate",
                                        "--methods",
                                        "ours,none",
                                        "--network",
                                        "ours=" + in("ours.onnx"),
                                        "--registration.warps",
                                        "1",
                                        "--registration.drive_m",
                                        "3",
                                        "--registration.sweeps",
                                        "false",
                                        "--out",
                                        in(out)};
    command.insert(command.end(), more.begin(), more.end());
    return testing::run_command(command);
  }

  TemporaryDirectory folder_;
};

TEST_F(AblateCommandEndToEnd, ComparesMethodsOnTheSameQuestions) {
  const CommandResult result = run({"--registration.plans", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto metrics = nlohmann::json::parse(content_of(in("out/metrics.json")));
  ASSERT_EQ(metrics["rows"].size(), 8U);  // tps and human, chained and around the truth
  for (const auto& row : metrics["rows"]) {
    const double error = row["translation_error_m"]["mean"];
    const double prior = row["prior_error_m"]["mean"];
    EXPECT_NEAR(error, prior, 1e-4) << row["method"];
  }
  for (const auto& difference : metrics["differences"]) {
    EXPECT_NEAR(difference["translation_error_m"]["mean"], 0.0, 1e-4);
  }
  EXPECT_THAT(content_of(in("out/report.html")), HasSubstr("The worst"));
  EXPECT_THAT(content_of(in("out/trials.csv")), HasSubstr("tps plan 1 drawing 1"));
}

TEST_F(AblateCommandEndToEnd, GivesTheSameForTheSameSeed) {
  ASSERT_EQ(run({"--registration.plans", "1", "--methods", "none"}, "a").exit_code, 0);
  ASSERT_EQ(run({"--registration.plans", "1", "--methods", "none", "--jobs", "2"}, "b").exit_code,
            0);
  EXPECT_EQ(content_of(in("a/metrics.json")), content_of(in("b/metrics.json")));
}

TEST_F(AblateCommandEndToEnd, AsksAboutRecordedRuns) {
  DataSetParams params;
  params.building = BuildingKind::Home;
  params.drive.length_m = 3.0;
  const DataSet made = generate_data_set(params, 4);
  write_sketch(in("d.png"), made.drawing.sketch);
  write_jsonl(in("log.jsonl"), made.run);
  write_reference(in("ref.csv"), made.reference, made.drawing.sketch.height_px());
  const CommandResult result =
      run({"--registration.plans", "0", "--set",
           in("d.png") + "," + in("log.jsonl") + "," + in("ref.csv") + ",home"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| home | chained | ours |"));
}

/// Whole runs of 3 m in one building.
class AblateWholeRunsEndToEnd : public AblateCommandEndToEnd {
 protected:
  std::vector<std::string> command_for(const std::string& suite, const std::string& out,
                                       const std::vector<std::string>& more) const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM,
                                        "ablate",
                                        "--suite",
                                        suite,
                                        "--network",
                                        "ours=" + in("ours.onnx"),
                                        "--drives.plans",
                                        "1",
                                        "--drives.drawings",
                                        "1",
                                        "--drives.drive_m",
                                        "3",
                                        "--out",
                                        in(out)};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }

  CommandResult run_suite(const std::string& suite, const std::string& out,
                          const std::vector<std::string>& more) const {
    return testing::run_command(command_for(suite, out, more));
  }

  nlohmann::json rows_of(const std::string& out) const {
    return nlohmann::json::parse(content_of(in(out + "/metrics.json")))["rows"];
  }

  void expect_same_results(const std::string& out, const std::string& other) const {
    for (const char* file : {"metrics.json", "report.html", "trials.jsonl", "run.yaml"}) {
      EXPECT_EQ(content_of(in(out + "/" + file)), content_of(in(other + "/" + file))) << file;
    }
  }

  const std::vector<std::string> kTwoSeeds = {"--methods", "odometry,ours_chained,mcl,ours",
                                              "--seeds", "2"};
};

std::vector<std::string> joined(std::vector<std::string> some,
                                const std::vector<std::string>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

TEST_F(AblateWholeRunsEndToEnd, GivesTheSameForAnyNumberOfJobs) {
  const CommandResult whole = run_suite("filter", "a", joined(kTwoSeeds, {"--jobs", "1"}));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const auto rows = rows_of("a");
  ASSERT_EQ(rows.size(), 8U);  // tps and human
  EXPECT_EQ(rows[0]["method"], "odometry");
  EXPECT_EQ(rows[0]["trials"], 1);  // nothing in it is drawn
  EXPECT_EQ(rows[3]["trials"], 2);
  EXPECT_THAT(content_of(in("a/report.html")), HasSubstr("How long until it is lost?"));
  EXPECT_THAT(content_of(in("a/run.yaml")), Not(HasSubstr("propose:")));  // the rows decide
  EXPECT_FALSE(fs::exists(in("a.unfinished")));

  const CommandResult other = run_suite("filter", "b", joined(kTwoSeeds, {"--jobs", "2"}));
  ASSERT_EQ(other.exit_code, 0) << other.err;
  expect_same_results("a", "b");
}

TEST_F(AblateWholeRunsEndToEnd, RefusesToGoOnWithSomethingElse) {
  fs::create_directory(in("a.unfinished"));
  std::ofstream(in("a.unfinished/what.yaml")) << "another program";
  const CommandResult refused = run_suite("filter", "a", {"--methods", "odometry"});
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.err, HasSubstr("beginning of another comparison"));
  EXPECT_FALSE(fs::exists(in("a")));
}

TEST_F(AblateWholeRunsEndToEnd, LooksAtWhatMayGoWrong) {
  const CommandResult result =
      run_suite("robust", "a", {"--methods", "odometry,mcl", "--seeds", "1"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> kinds;
  for (const auto& row : rows_of("a")) {
    kinds.insert(row["kind"]);
    EXPECT_GE(row["mean_error_m"]["mean"], 0.0);
  }
  EXPECT_THAT(kinds, IsSupersetOf({"plain", "odometry 40 %", "walls missing", "dropouts"}));
  EXPECT_THAT(content_of(in("a/report.html")), HasSubstr("Ablation: robust"));
}

#ifdef SKETCHLOC_MPIRUN
/// mpirun refuses root and more processes than cores, unless told otherwise.
std::vector<std::string> mpirun(std::vector<std::string> first, std::vector<std::string> second) {
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  ::setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
  std::vector<std::string> command = {SKETCHLOC_MPIRUN, "-n", "1"};
  command = joined(command, first);
  command = joined(command, {":", "-n", "1"});
  return joined(command, second);
}

TEST_F(AblateWholeRunsEndToEnd, GivesTheSameInTwoProcesses) {
  ASSERT_EQ(run_suite("filter", "a", joined(kTwoSeeds, {"--jobs", "1"})).exit_code, 0);
  const auto command = command_for("filter", "b", joined(kTwoSeeds, {"--jobs", "1"}));
  const CommandResult shared = testing::run_command(mpirun(command, command));
  ASSERT_EQ(shared.exit_code, 0) << shared.err;
  expect_same_results("a", "b");
}

TEST_F(AblateWholeRunsEndToEnd, EndsWhereAProcessIsAboutOtherWorkAndGoesOnLater) {
  ASSERT_EQ(run_suite("filter", "a", joined(kTwoSeeds, {"--jobs", "1"})).exit_code, 0);
  const auto command = command_for("filter", "b", joined(kTwoSeeds, {"--jobs", "1"}));
  const CommandResult other =
      testing::run_command(mpirun(command, joined(command, {"--filter.chain_way_m", "0.7"})));
  EXPECT_NE(other.exit_code, 0);
  EXPECT_THAT(other.err, HasSubstr("rank 1 has other options"));
  EXPECT_FALSE(fs::exists(in("b")));
  ASSERT_TRUE(fs::exists(in("b.unfinished")));
  ASSERT_EQ(run_suite("filter", "b", joined(kTwoSeeds, {"--jobs", "1"})).exit_code, 0);
  expect_same_results("a", "b");
}
#else
TEST_F(AblateWholeRunsEndToEnd, GivesTheSameInTwoProcesses) {
  GTEST_SKIP() << "built without SKETCHLOC_MPI";
}
#endif

TEST_F(AblateCommandEndToEnd, SaysWhatIsWrongWithItsInputs) {
  const auto refuses = [&](const std::vector<std::string>& more, const std::string& why) {
    const CommandResult result = run(more);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_FALSE(fs::exists(in("out")));
  };
  refuses({"--methods", "ours,magic"}, "there is no magic");
  refuses({"--registration.plans", "0"}, "nothing to run");
  refuses({"--registration.plans", "0", "--set", "a.png,b.log"}, "DRAWING,LOG,REFERENCE.csv");
  refuses({"--registration.plans", "0", "--set", in("no.png") + ",b.log,c.csv"}, "no.png");
  refuses({"--set", "a.png,b.log,c.csv", "--set", "a.png,b.log,d.csv"}, "two runs of the name a");
  refuses({"--network", "ours=" + in("none.onnx")}, "none.onnx");
  refuses({"--network", in("ours.onnx")}, "METHOD=FILE");
  refuses({"--suite", "cooking"}, "registration");
  refuses({"--registration.prior_turn_deg", "500"}, "prior_turn_deg");
}

TEST_F(AblateCommandEndToEnd, SaysWhatIsWrongWithWholeRuns) {
  const auto refuses = [&](const std::vector<std::string>& more, const std::string& why) {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM, "ablate", "--out", in("out")};
    command.insert(command.end(), more.begin(), more.end());
    const CommandResult result = testing::run_command(command);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_FALSE(fs::exists(in("out")));
    EXPECT_FALSE(fs::exists(in("out.unfinished")));
  };
  refuses({"--suite", "real", "--methods", "mcl"}, "nothing to run");
  refuses({"--suite", "filter", "--methods", "none"}, "there is no method none");
  refuses({"--suite", "filter", "--methods", "mcl", "--drives.drive_m", "0"}, "drive_m");
  refuses({"--suite", "filter", "--methods", "mcl", "--seeds", "0"}, "--seeds");
}

}  // namespace
}  // namespace sketchloc

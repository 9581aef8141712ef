#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "datasets/io/g2o_io.hpp"
#include "eval/keyframe_io.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::CommandResult;
using testing::content_of;
using ::testing::HasSubstr;

/// Four sides of 1 m whose turns are measured 3 deg short, and the loop.
constexpr const char* kSquare =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 1.52\nVERTEX_SE2 2 1 1 3.04\nVERTEX_SE2 3 0 1 -1.72\n"
    "VERTEX_SE2 4 9 9 -0.2\n"
    "EDGE_SE2 0 1 1 0 1.52 100 0 0 100 0 400\nEDGE_SE2 1 2 1 0 1.52 100 0 0 100 0 400\n"
    "EDGE_SE2 2 3 1 0 1.52 100 0 0 100 0 400\nEDGE_SE2 3 4 1 0 1.52 100 0 0 100 0 400\n"
    "EDGE_SE2 0 4 0 0 0 1e6 0 0 1e6 0 1e6\n";

class SmoothEndToEnd : public ::testing::Test {
 protected:
  CommandResult smooth(const std::string& content,
                       const std::vector<std::string>& flags = {}) const {
    std::ofstream(folder_ / "in.g2o") << content;
    std::vector<std::string> command = {SKETCHLOC_PROGRAM,  "smooth", "--graph",
                                        folder_ / "in.g2o", "--out",  folder_ / "out"};
    command.insert(command.end(), flags.begin(), flags.end());
    return testing::run_command(command);
  }
  nlohmann::json metrics() const {
    return nlohmann::json::parse(content_of(folder_ / "out/metrics.json"));
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(SmoothEndToEnd, WritesTheGraphItsFiguresAPictureAndHowTheyWereMade) {
  const CommandResult result = smooth(kSquare);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("5 vertices, 5 edges"));
  const PoseGraph graph = read_g2o(folder_ / "out/graph.g2o");
  EXPECT_NEAR(graph.vertices[4].frame_from_body.x, 0.0, 1e-3);
  EXPECT_NEAR(graph.vertices[2].frame_from_body.x, 1.0, 0.05);
  const nlohmann::json figures = metrics();
  EXPECT_EQ(figures["status"], "converged");
  EXPECT_EQ(figures["kernel"], "none");
  EXPECT_LT(figures["chi2"], figures["start_chi2"]);
  EXPECT_NEAR(figures["chi2"].get<double>(), 4.0 * 400.0 * 0.0508 * 0.0508, 0.1);
  EXPECT_GE(figures["iterations"], 1);
  EXPECT_GE(figures["seconds"], 0.0);
  EXPECT_THAT(content_of(folder_ / "out/picture.png"), HasSubstr("PNG"));
  EXPECT_THAT(content_of(folder_ / "out/run.yaml"), HasSubstr("command: smooth"));
}

TEST_F(SmoothEndToEnd, StartsFromDeadReckoningAndEndsTheSame) {
  ASSERT_EQ(smooth(kSquare).exit_code, 0);
  const double given = metrics()["chi2"];
  const double start = metrics()["start_chi2"];
  ASSERT_EQ(smooth(kSquare, {"--start", "odometry", "--force"}).exit_code, 0);
  EXPECT_NEAR(metrics()["chi2"].get<double>(), given, 1e-6);
  EXPECT_LT(metrics()["start_chi2"], start);  // the file has the last pose far off
}

TEST_F(SmoothEndToEnd, AKernelLeavesOutAWrongLoop) {
  const std::string wrong = std::string(kSquare) + "EDGE_SE2 1 3 5 5 0 1e4 0 0 1e4 0 1e4\n";
  ASSERT_EQ(smooth(wrong, {"--kernel", "graduated"}).exit_code, 0);
  EXPECT_EQ(metrics()["kernel"], "graduated");
  EXPECT_EQ(metrics()["rejected_edges"], 1);
  EXPECT_NEAR(read_g2o(folder_ / "out/graph.g2o").vertices[2].frame_from_body.x, 1.0, 0.05);
}

TEST_F(SmoothEndToEnd, GrowsAGraphVertexByVertexToTheSameEnd) {
  ASSERT_EQ(smooth(kSquare).exit_code, 0);
  const double at_once = metrics()["chi2"];
  ASSERT_EQ(smooth(kSquare, {"--incremental", "--force"}).exit_code, 0);
  EXPECT_NEAR(metrics()["chi2"].get<double>(), at_once, 1e-3);
  EXPECT_EQ(metrics()["updates"], 5);
  EXPECT_EQ(smooth(kSquare, {"--incremental", "--kernel", "graduated", "--force"}).exit_code, 2);
}

TEST_F(SmoothEndToEnd, ComparesWithAReference) {
  std::ofstream(folder_ / "ref.g2o") << kSquare;
  ASSERT_EQ(smooth(kSquare, {"--reference", folder_ / "ref.g2o"}).exit_code, 0);
  EXPECT_NEAR(metrics()["rmse_m"].get<double>(), 4.1, 1.0);  // the file's last pose is far off
}

TEST_F(SmoothEndToEnd, RepeatsARunFromItsRunYaml) {
  ASSERT_EQ(smooth(kSquare, {"--kernel", "cauchy", "--start", "odometry"}).exit_code, 0);
  const CommandResult again =
      testing::run_command({SKETCHLOC_PROGRAM, "smooth", "--config", folder_ / "out/run.yaml",
                            "--out", folder_ / "again"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(content_of(folder_ / "again/graph.g2o"), content_of(folder_ / "out/graph.g2o"));
  EXPECT_EQ(content_of(folder_ / "again/run.yaml"), content_of(folder_ / "out/run.yaml"));
}

TEST_F(SmoothEndToEnd, NeverReplacesAResultUnasked) {
  ASSERT_EQ(smooth(kSquare).exit_code, 0);
  EXPECT_EQ(smooth(kSquare).exit_code, 2);
  EXPECT_EQ(smooth(kSquare, {"--force"}).exit_code, 0);
}

TEST_F(SmoothEndToEnd, SaysThatAShortRunHasNoSpline) {
  Keyframe alone;
  alone.hypotheses.emplace_back();
  const KeyframeRun run{.keyframes = {alone}};
  std::ofstream(folder_ / "keyframes.jsonl") << to_jsonl(run);
  const CommandResult result =
      testing::run_command({SKETCHLOC_PROGRAM, "smooth", folder_ / ".", "--out", folder_ / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no spline.json: the way is shorter than the 2 m"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/trajectory.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/spline.json"));
}

TEST_F(SmoothEndToEnd, SaysWhatIsWrongAndLeavesNothing) {
  const CommandResult broken = smooth("VERTEX_SE2 0 0 0\n");
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.err, HasSubstr("in.g2o:1: theta"));
  EXPECT_EQ(smooth(kSquare, {"--kernel", "magic"}).exit_code, 2);
  EXPECT_EQ(smooth(kSquare, {"--optimise.kernel.width", "0"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace sketchloc

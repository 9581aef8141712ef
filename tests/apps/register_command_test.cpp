#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_writer.hpp"
#include "datasets/sim/data_set.hpp"
#include "motion/angles.hpp"
#include "motion/number_text.hpp"
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
using testing::TemporaryDirectory;

nlohmann::json json_in(const fs::path& file) { return nlohmann::json::parse(content_of(file)); }

std::string typed(const Sim2& pose) {
  return number_text(pose.x()) + "," + number_text(pose.y()) + "," +
         number_text(deg_from_rad(pose.yaw_rad())) + "," + number_text(pose.scale());
}

/// A small simulated home, and networks that say the same whatever they see: ours that the pose
/// is 1 m ahead of where it looked from and the floor not bent, affine's that it is at the prior
/// and heads to the right.
class RegisterCommandEndToEnd : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new TemporaryDirectory();
    DataSetParams params;
    params.building = BuildingKind::Home;
    params.drive.length_m = 4.0;
    DataSet made = generate_data_set(params, 3);
    made.run.steps[1].scan.ranges_m.assign(made.run.steps[1].scan.ranges_m.size(), 0.0F);
    write_sketch(*inputs_ / "home & <garden>.png", made.drawing.sketch);
    write_jsonl(*inputs_ / "log.jsonl", made.run);
    write_reference(*inputs_ / "reference.csv", made.reference, made.drawing.sketch.height_px());
    steps_ = made.run.steps.size();
    true_sketch_from_robot_ = made.reference.poses.front().sketch_from_robot;
    std::vector<float> ahead(ResidualOutput::kSize, 0.0F);
    ahead[ResidualOutput::kPose] = 1.0F;
    std::ofstream(*inputs_ / "ours.onnx", std::ios::binary)
        << testing::constant_network(InputKind::Residual, ahead);
    const std::vector<float> identity = {1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
    std::ofstream(*inputs_ / "affine.onnx", std::ios::binary)
        << testing::constant_network(InputKind::Published, identity);
  }
  static void TearDownTestSuite() { delete inputs_; }

  static std::string input(const std::string& name) { return (*inputs_ / name).string(); }

  /// From the true pose of the first scan, with the network of ours.
  CommandResult run(const std::vector<std::string>& more,
                    const std::string& network = input("ours.onnx")) const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM, "register",
                                        "--map",           input("home & <garden>.png"),
                                        "--log",           input("log.jsonl")};
    if (!network.empty()) {
      command.insert(command.end(), {"--network", network});
    }
    command.insert(command.end(), more.begin(), more.end());
    return testing::run_command(command);
  }
  static std::vector<std::string> at_truth(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"--prior", typed(true_sketch_from_robot_)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  static TemporaryDirectory* inputs_;
  static std::size_t steps_;
  static Sim2 true_sketch_from_robot_;
  TemporaryDirectory outputs_;
};

TemporaryDirectory* RegisterCommandEndToEnd::inputs_ = nullptr;
std::size_t RegisterCommandEndToEnd::steps_ = 0;
Sim2 RegisterCommandEndToEnd::true_sketch_from_robot_;

TEST_F(RegisterCommandEndToEnd, SaysWhereTheRobotIsAndWritesAFolder) {
  const fs::path out = outputs_ / "result";
  const CommandResult result =
      run(at_truth({"--out", out.string(), "--reference", input("reference.csv"),
                    "--predictor.looks", "2", "--predictor.fine_side_m", "8"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  // 1 m by the first look, half as much through a window of half the size
  EXPECT_THAT(result.out, HasSubstr("from the prior: 1.50 m, 0.0 deg"));
  EXPECT_THAT(result.out, HasSubstr("from the reference: 1.50 m"));
  EXPECT_THAT(result.out, HasSubstr("alignment of the bent scan with the strokes: 0."));
  EXPECT_THAT(result.out, HasSubstr("the warp does not fold within the window of 8 m"));
  for (const char* file : {"registration.json", "registration.png", "report.html", "run.yaml"}) {
    EXPECT_GT(fs::file_size(out / file), 0U) << file;
  }
  const nlohmann::json json = json_in(out / "registration.json");
  EXPECT_NEAR(json["from_prior"]["shift_m"].get<double>(), 1.5, 1e-6);
  EXPECT_GT(json["alignment"].get<double>(), 0.0);
  EXPECT_LT(json["alignment"].get<double>(), 1.0);
  EXPECT_NEAR(json["error"]["prior"]["shift_m"].get<double>(), 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(json["inlier_probability"], 0.5);
  EXPECT_THAT(content_of(out / "report.html"), HasSubstr("home &amp; &lt;garden&gt;.png"));
}

TEST_F(RegisterCommandEndToEnd, LooksAtTheScansOfTheLastMetresOrAtOneAlone) {
  const std::string last = std::to_string(steps_ - 1);
  const auto scans = [&](const std::vector<std::string>& more, const std::string& network) {
    const CommandResult result = run(at_truth(more), network);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out)["scans"].get<int>();
  };
  EXPECT_GT(scans({"--json", "--scan", last}, input("ours.onnx")), 1);
  EXPECT_EQ(scans({"--json", "--scan", last, "--single-scan"}, input("ours.onnx")), 1);
  EXPECT_EQ(scans({"--json", "--scan", last, "--method", "affine"}, input("affine.onnx")), 1);
}

TEST_F(RegisterCommandEndToEnd, IsRepeatedByItsRunFile) {
  const fs::path first = outputs_ / "first";
  ASSERT_EQ(run(at_truth({"--out", first.string(), "--scan", "2", "--single-scan"})).exit_code, 0);
  const CommandResult again =
      testing::run_command({SKETCHLOC_PROGRAM, "register", "--config",
                            (first / "run.yaml").string(), "--out", (outputs_ / "again").string()});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  nlohmann::json one = json_in(first / "registration.json");
  nlohmann::json two = json_in(outputs_ / "again/registration.json");
  one.erase("milliseconds");
  two.erase("milliseconds");
  EXPECT_EQ(one, two);
  EXPECT_EQ(content_of(first / "registration.png"),
            content_of(outputs_ / "again/registration.png"));
}

TEST_F(RegisterCommandEndToEnd, FindsTheScanOfATime) {
  const CommandResult result = run(at_truth({"--time", "0.01", "--json"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["scan"], 0);
}

TEST_F(RegisterCommandEndToEnd, SaysWhatIsWrongWithAnInput) {
  const auto message = [&](int exit_code, const std::vector<std::string>& more,
                           const std::string& network = input("ours.onnx")) {
    const CommandResult result = run(more, network);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    return result.err;
  };
  EXPECT_THAT(message(2, at_truth({"--scan", "9999"})), HasSubstr("has scans 0 to"));
  EXPECT_THAT(message(2, at_truth({"--time", "1e9"})), HasSubstr("has scans from 0 to"));
  EXPECT_THAT(message(1, at_truth({"--scan", "1"})), HasSubstr("scan 1 has no return"));
  EXPECT_THAT(message(2, {"--prior", "1e6,0,0"}), HasSubstr("--prior 1e6,0,0: the place is outs"));
  EXPECT_THAT(message(2, {"--prior", "1,2"}), HasSubstr("--prior must be X,Y,HEADING_DEG"));
  EXPECT_THAT(message(2, at_truth({"--method", "icp"})), HasSubstr("icp runs no network"));
  EXPECT_THAT(message(1, at_truth(), input("log.jsonl")),
              HasSubstr("log.jsonl: is no network for"));
  EXPECT_THAT(message(1, at_truth(), input("affine.onnx")),
              HasSubstr("affine.onnx: is no network for --method ours"));
  EXPECT_THAT(message(1, at_truth(), input("")), HasSubstr("cannot be read"));
  EXPECT_THAT(message(1, at_truth(), input("none.onnx")), HasSubstr("none.onnx: cannot be read"));
}

TEST_F(RegisterCommandEndToEnd, NeverOverwritesWithoutBeingAsked) {
  const std::vector<std::string> arguments = at_truth({"--out", (outputs_ / "one").string()});
  EXPECT_EQ(run(arguments).exit_code, 0);
  EXPECT_EQ(run(arguments).exit_code, 2);
}

}  // namespace
}  // namespace sketchloc

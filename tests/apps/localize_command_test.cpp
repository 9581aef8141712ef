#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "datasets/sim/data_set.hpp"
#include "eval/step_table.hpp"
#include "motion/angles.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using testing::content_of;
using ::testing::HasSubstr;
using testing::TemporaryDirectory;

void write_pgm(const fs::path& file, const Sketch& sketch) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << sketch.width_px() << " " << sketch.height_px() << "\n255\n";
  for (int row = sketch.height_px() - 1; row >= 0; --row) {
    for (const std::uint8_t cell : sketch.occupied.row(row)) {
      out.put(cell != 0 ? '\0' : '\xFF');
    }
  }
}

/// A small simulated home in files, made once for all tests.
class LocalizeCommandEndToEnd : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new TemporaryDirectory();
    DataSetParams params;
    params.building = BuildingKind::Home;
    params.drive.length_m = 8.0;
    const DataSet made = generate_data_set(params, 3);
    write_pgm(*inputs_ / "home & <garden>.pgm", made.drawing.sketch);
    write_jsonl(*inputs_ / "log.jsonl", made.run);
    write_reference(*inputs_ / "reference.csv", made.reference, made.drawing.sketch.height_px());
    start_sketch_from_robot_ = made.reference.poses.front().sketch_from_robot;
  }
  static void TearDownTestSuite() { delete inputs_; }

  CommandResult localize(const fs::path& out, const std::vector<std::string>& more,
                         fs::path log = {}) const {
    log = log.empty() ? *inputs_ / "log.jsonl" : log;
    std::vector<std::string> command = {SKETCHLOC_PROGRAM,
                                        "localize",
                                        "--map",
                                        (*inputs_ / "home & <garden>.pgm").string(),
                                        "--log",
                                        log.string(),
                                        "--out",
                                        out.string(),
                                        "--localizer.particles.min_particles",
                                        "1000",
                                        "--localizer.particles.max_particles",
                                        "2000",
                                        "--localizer.table.memory_mb",
                                        "20"};
    command.insert(command.end(), more.begin(), more.end());
    return testing::run_command(command);
  }
  /// The reference in the form of an alternative reading.
  std::string reference_as_alternative() const {
    std::ifstream reference(*inputs_ / "reference.csv");
    std::ofstream alternative(outputs_ / "alternative.csv");
    for (std::string line; std::getline(reference, line);) {
      const bool header = line.starts_with("t_index");
      alternative << line << (header ? ",distance_to_A_px" : ",0") << "\n";
    }
    return (outputs_ / "alternative.csv").string();
  }
  std::vector<std::string> with_reference() const {
    return {"--reference", (*inputs_ / "reference.csv").string(), "--start-from-reference"};
  }

  static TemporaryDirectory* inputs_;
  static Sim2 start_sketch_from_robot_;
  TemporaryDirectory outputs_;
};

TemporaryDirectory* LocalizeCommandEndToEnd::inputs_ = nullptr;
Sim2 LocalizeCommandEndToEnd::start_sketch_from_robot_;

TEST_F(LocalizeCommandEndToEnd, WritesAFolderOfResults) {
  const fs::path out = outputs_ / "result";
  const CommandResult result = localize(out, with_reference());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("within 1 m / 2 m of the reference"));
  for (const char* file : {"trajectory.tum", "trajectory.csv", "metrics.json", "report.html",
                           "picture.png", "run.yaml"}) {
    EXPECT_GT(fs::file_size(out / file), 0U) << file;
  }
  EXPECT_THAT(content_of(out / "trajectory.tum"), HasSubstr("# frame: sketch, px"));
  EXPECT_THROW(read_tum(out / "trajectory.tum"), std::runtime_error);  // no metres
  EXPECT_THAT(content_of(out / "metrics.json"), HasSubstr("\"share_within_2_m\""));
  EXPECT_THAT(content_of(out / "report.html"), HasSubstr("home &amp; &lt;garden&gt;.pgm"));
}

TEST_F(LocalizeCommandEndToEnd, SmoothsARunAndSmoothsItAgainFromItsFolder) {
  const fs::path out = outputs_ / "smoothed";
  std::vector<std::string> more = with_reference();
  more.insert(more.end(), {"--method", "ours", "--smooth"});
  const CommandResult result = localize(out, more);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(fs::file_size(out / "filtered.csv"), 0U);
  const std::vector<StepReport> smoothed = read_step_table(out / "trajectory.csv");
  EXPECT_EQ(read_step_table(out / "filtered.csv").size(), smoothed.size());
  const fs::path anew = outputs_ / "anew";
  const CommandResult again =
      testing::run_command({SKETCHLOC_PROGRAM, "smooth", out.string(), "--out", anew.string()});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (const StepReport& keyframe : read_step_table(anew / "trajectory.csv")) {
    const Sim2& same = smoothed.at(keyframe.step).estimate.sketch_from_robot;
    EXPECT_NEAR(keyframe.estimate.sketch_from_robot.x(), same.x(), 1e-3);
    EXPECT_NEAR(keyframe.estimate.sketch_from_robot.y(), same.y(), 1e-3);
  }
  EXPECT_TRUE(fs::exists(out / "overlay.png"));
  for (const fs::path& folder : {out, anew}) {
    std::ifstream file(folder / "spline.json");
    const nlohmann::json spline = nlohmann::json::parse(file);
    EXPECT_EQ(spline.at("poses").size(), read_step_table(anew / "trajectory.csv").size());
    EXPECT_GE(spline.at("controls").size(), 9U);
    EXPECT_LT(spline.at("residual_m").get<double>(), 2.0);
  }
}

TEST_F(LocalizeCommandEndToEnd, GivesPosesAsTheyAreKnownALagLater) {
  const fs::path out = outputs_ / "lagged";
  std::vector<std::string> more = with_reference();
  more.insert(more.end(), {"--method", "ours", "--lag", "--smoothing.lag.lag_m", "3"});
  const CommandResult result = localize(out, more);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<StepReport> lagged = read_step_table(out / "trajectory.csv");
  const std::vector<StepReport> filtered = read_step_table(out / "filtered.csv");
  ASSERT_EQ(lagged.size(), filtered.size());
  const auto moved_px = [&](std::size_t i) {
    return (lagged[i].estimate.sketch_from_robot.translation() -
            filtered[i].estimate.sketch_from_robot.translation())
        .norm();
  };
  EXPECT_GT(moved_px(lagged.size() / 2), 0.0);
  EXPECT_FALSE(fs::exists(out / "keyframes.jsonl"));
  EXPECT_FALSE(fs::exists(out / "spline.json"));
}

TEST_F(LocalizeCommandEndToEnd, SaysWhatSmoothingNeeds) {
  std::vector<std::string> more = with_reference();
  more.insert(more.end(), {"--method", "mcl", "--smooth"});
  const CommandResult alone = localize(outputs_ / "alone", more);
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_THAT(alone.err, HasSubstr("--method ours"));
  const CommandResult missing = testing::run_command(
      {SKETCHLOC_PROGRAM, "smooth", outputs_.path().string(), "--out", outputs_ / "none"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, HasSubstr("sketchloc localize --smooth"));
  EXPECT_EQ(
      testing::run_command({SKETCHLOC_PROGRAM, "smooth", "--out", outputs_ / "none"}).exit_code, 2);
}

TEST_F(LocalizeCommandEndToEnd, GivesTheSameTrajectoryForTheSameSeed) {
  ASSERT_EQ(localize(outputs_ / "one", with_reference()).exit_code, 0);
  std::vector<std::string> more = with_reference();
  more.insert(more.end(), {"--jobs", "2"});
  ASSERT_EQ(localize(outputs_ / "two", more).exit_code, 0);
  EXPECT_EQ(content_of(outputs_ / "one/trajectory.csv"),
            content_of(outputs_ / "two/trajectory.csv"));
  std::vector<std::string> other_seed = with_reference();
  other_seed.insert(other_seed.end(), {"--seed", "2"});
  ASSERT_EQ(localize(outputs_ / "three", other_seed).exit_code, 0);
  EXPECT_NE(content_of(outputs_ / "one/trajectory.csv"),
            content_of(outputs_ / "three/trajectory.csv"));
}

TEST_F(LocalizeCommandEndToEnd, StartsAnywhereWithoutAStart) {
  ASSERT_EQ(localize(outputs_ / "default", {}).exit_code, 0);
  ASSERT_EQ(localize(outputs_ / "global", {"--global"}).exit_code, 0);
  EXPECT_EQ(content_of(outputs_ / "default/trajectory.csv"),
            content_of(outputs_ / "global/trajectory.csv"));
  ASSERT_EQ(localize(outputs_ / "known", with_reference()).exit_code, 0);
  EXPECT_NE(content_of(outputs_ / "default/trajectory.csv"),
            content_of(outputs_ / "known/trajectory.csv"));
}

TEST_F(LocalizeCommandEndToEnd, RunsAgainFromItsRunFileAlone) {
  std::vector<std::string> more = with_reference();
  more.insert(more.end(), {"--seed", "5", "--odometry", "raw", "--title", "an: odd 'title'",
                           "--max-range-m", "6.5", "--alternative", reference_as_alternative(),
                           "--alternative", reference_as_alternative()});
  ASSERT_EQ(localize(outputs_ / "one", more).exit_code, 0);
  const std::string run_file = (outputs_ / "one/run.yaml").string();
  const auto again = [&](const std::string& out, std::vector<std::string> others) {
    others.insert(others.begin(), {SKETCHLOC_PROGRAM, "localize", "--config", run_file, "--out",
                                   (outputs_ / out).string()});
    const CommandResult result = testing::run_command(others);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return content_of(outputs_ / out / "trajectory.csv");
  };
  const std::string first = content_of(outputs_ / "one/trajectory.csv");
  EXPECT_EQ(again("two", {}), first);
  EXPECT_EQ(content_of(outputs_ / "two/run.yaml"), content_of(run_file));
  EXPECT_NE(again("other_seed", {"--seed", "6"}), first);
  EXPECT_NE(again("other_odometry", {"--odometry", "matched"}), first);
  EXPECT_NE(again("other_range", {"--max-range-m", "60"}), first);
  EXPECT_NE(again("other_start", {"--global"}), first);
}

TEST_F(LocalizeCommandEndToEnd, NeverReplacesAResultUnlessForced) {
  const fs::path out = outputs_ / "result";
  ASSERT_EQ(localize(out, with_reference()).exit_code, 0);
  const CommandResult again = localize(out, with_reference());
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  std::vector<std::string> forced = with_reference();
  forced.emplace_back("--force");
  EXPECT_EQ(localize(out, forced).exit_code, 0);
}

TEST_F(LocalizeCommandEndToEnd, FindsTheScaleOfATypedStart) {
  std::ostringstream start;
  start << start_sketch_from_robot_.x() << "," << start_sketch_from_robot_.y() << ","
        << deg_from_rad(start_sketch_from_robot_.yaw_rad());
  const CommandResult guessed = localize(outputs_ / "guessed", {"--start", start.str()});
  EXPECT_EQ(guessed.exit_code, 0) << guessed.err;
  EXPECT_THAT(guessed.err, HasSubstr("px/m there"));
  const CommandResult typed = localize(outputs_ / "typed", {"--start", start.str() + ",20"});
  EXPECT_EQ(typed.exit_code, 0) << typed.err;
}

TEST_F(LocalizeCommandEndToEnd, SaysWhatIsWrongWithItsOptions) {
  const auto fails_with = [&](const std::vector<std::string>& more, const std::string& message) {
    const CommandResult result = localize(outputs_ / "result", more);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(fs::exists(outputs_ / "result"));
  };
  fails_with({"--start", "1,2,3,4", "--global"}, "excludes");
  fails_with({"--start", "-5,20,0,20"}, "home & <garden>.pgm, which is ");
  fails_with({"--start", "20,90000,0"}, " px wide and ");
  fails_with({"--start-from-reference"}, "needs --reference");
  fails_with({"--method", "odometry"}, "needs --start");
  fails_with({"--method", "magic"}, "--method");
  fails_with({"--method", "chen20"}, "needs --start");
  fails_with({"--method", "mcl", "--network", "ours.onnx"}, "--method mcl runs no network");
  fails_with({"--localizer.fusion.max_modes", "0"}, "max_modes");
  fails_with({"--start", "1,2"}, "X,Y,HEADING_DEG");
  fails_with({"--localizer.gate.way_m", "-1"}, "way_m");
}

TEST_F(LocalizeCommandEndToEnd, TakesZeroJobsForOnePerCore) {
  std::vector<std::string> more = with_reference();
  more.insert(more.end(), {"--jobs", "0"});
  const CommandResult result = localize(outputs_ / "result", more);
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(LocalizeCommandEndToEnd, PrintsTheDefaultsForTheGivenMap) {
  std::ofstream(outputs_ / "map.pgm") << "P2 4 3 255\n0 0 0 0 0 255 255 0 0 0 0 0\n";
  std::ofstream(outputs_ / "map.yaml")
      << "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
      << "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const auto printed = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {SKETCHLOC_PROGRAM, "localize", "--print-parameters"});
    const CommandResult result = testing::run_command(more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  EXPECT_THAT(printed({}), HasSubstr("measurement: beams"));
  EXPECT_THAT(printed({"--map", (outputs_ / "map.yaml").string()}),
              HasSubstr("measurement: end_points"));
}

TEST_F(LocalizeCommandEndToEnd, LeavesNothingBehindWhenTheDataFail) {
  std::ofstream(outputs_ / "bad.jsonl") << "{\"time_s\": 0\n";
  const CommandResult result = localize(outputs_ / "result", {}, outputs_ / "bad.jsonl");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("bad.jsonl"));
  EXPECT_EQ(std::distance(fs::directory_iterator(outputs_.path()), fs::directory_iterator()), 1);
}

TEST_F(LocalizeCommandEndToEnd, IsEvaluatedAgainWithTheSameFigures) {
  const fs::path out = outputs_ / "result";
  ASSERT_EQ(localize(out, with_reference()).exit_code, 0);
  const CommandResult result =
      testing::run_command({SKETCHLOC_PROGRAM, "evaluate", "--run", out.string(), "--reference",
                            (*inputs_ / "reference.csv").string(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json written = nlohmann::json::parse(content_of(out / "metrics.json"));
  const nlohmann::json again = nlohmann::json::parse(result.out);
  EXPECT_EQ(again.at("share_within_1_m"), written.at("share_within_1_m"));
  EXPECT_NEAR(again.at("translation_error_m").at("rmse").get<double>(),
              written.at("translation_error_m").at("rmse").get<double>(), 1e-9);
  EXPECT_NEAR(again.at("heading_error_deg").at("mean").get<double>(),
              written.at("heading_error_deg").at("mean").get<double>(), 1e-9);
  EXPECT_TRUE(again.at("seconds").is_null());
  std::ofstream(outputs_ / "other.pgm") << "P2 3 2 255\n0 255 0 255 255 255\n";
  const CommandResult other = testing::run_command(
      {SKETCHLOC_PROGRAM, "evaluate", "--run", out.string(), "--map",
       (outputs_ / "other.pgm").string(), "--polarity", "dark-on-light", "--drawn",
       "filled-free-space", "--reference", (*inputs_ / "reference.csv").string()});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("is 3 x 2 px, but the run was in a drawing of"));
}

TEST_F(LocalizeCommandEndToEnd, RefusesTheReferenceOfAnotherRunAndWarnsOfAShortOne) {
  std::ifstream reference(*inputs_ / "reference.csv");
  std::ofstream later(outputs_ / "later.csv");
  std::ofstream two(outputs_ / "two.csv");
  int lines = 0;
  for (std::string line; std::getline(reference, line); ++lines) {
    const std::size_t comma = line.find(',');
    later << line.substr(0, comma + 1) << (lines > 0 ? "9" : "") << line.substr(comma + 1) << "\n";
    two << (lines < 3 ? line + "\n" : "");
  }
  later.close();
  two.close();
  const CommandResult refused =
      localize(outputs_ / "one", {"--reference", (outputs_ / "later.csv").string()});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("later.csv: its times are not those of"));
  const CommandResult warned = localize(
      outputs_ / "two", {"--reference", (outputs_ / "two.csv").string(), "--start-from-reference"});
  EXPECT_EQ(warned.exit_code, 0) << warned.err;
  EXPECT_THAT(warned.err, HasSubstr("two.csv: has poses for 2 of the"));
}

TEST_F(LocalizeCommandEndToEnd, NamesTheFlagWhereAValueMakesNoSense) {
  const auto message = [&](const std::vector<std::string>& more) {
    const CommandResult result = localize(outputs_ / "none", more);
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_THAT(message({"--seed", "-1"}), HasSubstr("--seed: must be a whole number, 0 or more"));
  EXPECT_THAT(message({"--method", "foo"}),
              HasSubstr("mcl+propose, ours+smooth, ours+lag or ours, but it is 'foo'"));
  EXPECT_THAT(message({"--max-range-m", "0"}),
              HasSubstr("must be a number above 0, but it is '0'"));
  EXPECT_THAT(message({"--start", ""}), HasSubstr("--start must be X,Y,HEADING_DEG"));
  EXPECT_THAT(message({"--start", "20,20,400,1e9"}), HasSubstr("PX_PER_M the longer side"));
  EXPECT_THAT(message({"--localizer.colour", "1"}), HasSubstr("unknown: --localizer.colour 1"));
  EXPECT_THAT(message({"--localizer.particles.max_particles"}),
              HasSubstr("--localizer.particles.max_particles: needs a value"));
}

}  // namespace
}  // namespace sketchloc

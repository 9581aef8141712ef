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
using ::testing::Not;
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

TEST_F(EvaluateCommandEndToEnd, EvaluatesAgainFromItsRunFileAlone) {
  ASSERT_EQ(evaluate({"--trajectory", file("estimate.tum"), "--reference", file("reference.tum"),
                      "--delta-m", "2", "--delta-frames", "1", "2", "--out", file("one")})
                .exit_code,
            0);
  const CommandResult again = evaluate({"--config", file("one/run.yaml"), "--out", file("two")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("RPE over 2 m"));
  EXPECT_THAT(again.out, Not(HasSubstr("RPE over 5 m")));
  EXPECT_THAT(again.out, HasSubstr("RPE over 2 frames"));
  std::ofstream(folder_ / "tune.yaml") << "a: 1\n";
  EXPECT_THAT(evaluate({"--config", file("tune.yaml")}).err, HasSubstr("run.yaml of an earlier"));
}

/// What a run leaves behind that a table needs.
void write_metrics(const std::filesystem::path& run, double share_within_2_m, bool lost) {
  std::filesystem::create_directories(run);
  std::ofstream(run / "metrics.json")
      << R"({"scored_poses": 9, "share_within_1_m": 0.25, "share_within_2_m": )" << share_within_2_m
      << R"(, "translation_error_m": {"median": 0.5}, )"
      << R"("heading_error_deg": {"median": 10}, "first_loss_s": null, "lost_at_end": )"
      << (lost ? "true" : "false") << "}";
}

TEST_F(EvaluateCommandEndToEnd, SumsUpManyRuns) {
  for (const int seed : {1, 2, 3, 4}) {
    write_metrics(folder_ / "castle/mcl" / std::to_string(seed), 0.5 + 0.1 * seed, seed == 1);
    write_metrics(folder_ / "castle/odometry" / std::to_string(seed), 0.4 + 0.1 * seed, true);
  }
  const CommandResult result = evaluate({"--runs", file("castle/mcl"), file("castle/odometry/"),
                                         "--against", file("castle/odometry")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| castle | mcl | 4 | 25 [25, 25] | 75 ["));
  EXPECT_THAT(result.out, HasSubstr("| 60 | 0.50 [0.50, 0.50] | 10.0 [10.0, 10.0] | never | "
                                    "25 [5, 70] |\n"));  // Wilson, worked by hand
  EXPECT_THAT(result.out, HasSubstr("| castle | mcl | 4 | +10.0 [+10.0, +10.0] |"));
}

TEST_F(EvaluateCommandEndToEnd, SaysWhichOfManyRunsIsUnfinished) {
  write_metrics(folder_ / "castle/mcl/1", 0.5, false);
  std::filesystem::create_directories(folder_ / "castle/mcl/2");
  const CommandResult result = evaluate({"--runs", file("castle/mcl")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("castle/mcl/2/metrics.json: cannot be read"));
  EXPECT_EQ(evaluate({"--runs", file("castle/none")}).exit_code, 1);
  EXPECT_EQ(evaluate({"--runs", file("castle/mcl"), "--json"}).exit_code, 2);
}

TEST_F(EvaluateCommandEndToEnd, SaysWhatIsWrong) {
  EXPECT_EQ(evaluate({"--reference", file("reference.tum")}).exit_code, 2);
  EXPECT_EQ(evaluate({"--run", file("x"), "--reference", file("reference.tum")}).exit_code, 2);
  std::ofstream(folder_ / "later.tum") << "100 0 0 0 0 0 0 1\n";
  const CommandResult later =
      evaluate({"--trajectory", file("later.tum"), "--reference", file("reference.tum")});
  EXPECT_EQ(later.exit_code, 1);
  EXPECT_THAT(later.err, HasSubstr("the times do not overlap"));
  EXPECT_THAT(evaluate({"--trajectory", "x", "--reference", "y", "--delta-m", "-1"}).err,
              HasSubstr("--delta-m: must be a number above 0, but it is '-1'"));
}

/// A wall 2 m ahead of a robot that drives 4 m along it; the wheels measure 10 % too much.
class EvaluateLogEndToEnd : public EvaluateCommandEndToEnd {
 protected:
  EvaluateLogEndToEnd() {
    std::ofstream log(folder_ / "drive.log");
    for (int i = 0; i <= 4; ++i) {
      log << "FLASER 3 9 2 9 " << i << " 0 0 " << 1.1 * i << " 0 0 " << i << " host " << i << "\n";
    }
    std::ofstream(folder_ / "drive.relations") << "0 4 4 0 0 0 0 0\n";
    std::ofstream picture(folder_ / "drawing.pgm");
    picture << "P2 100 100 255\n";
    for (int cell = 0; cell < 100 * 100; ++cell) {
      picture << (cell % 100 == 50 ? "0 " : "255 ");
    }
    std::ofstream(folder_ / "reference.csv")
        << "t_index,t,sketch_x_px,sketch_y_px,heading_rad,heading_rigid_rad,local_scale_px_per_m,"
           "loo_uncertainty_m,local_rotation_deg_yup,anisotropy,in_image,in_hull,"
           "dist_nearest_correspondence_m\n"
        << "0,0,29.5,50,0,0,10,0,0,1,1,1,0\n";
  }
};

TEST_F(EvaluateLogEndToEnd, ComparesTheOdometryOfALogWithRelations) {
  const CommandResult result =
      evaluate({"--log", file("drive.log"), "--relations", file("drive.relations")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| relations up to 60 s | wheels | 1 | 0.400 |"));
  EXPECT_THAT(result.out, HasSubstr("| corrected poses, over 1 m | wheels | 4 | 0.100 |"));
  const CommandResult json = evaluate({"--log", file("drive.log"), "--json"});
  EXPECT_THAT(json.out, HasSubstr("\"increment_nees\""));
}

TEST_F(EvaluateLogEndToEnd, LooksAtTheScansOfALogInADrawing) {
  const CommandResult result = evaluate({"--log", file("drive.log"), "--map", file("drawing.pgm"),
                                         "--reference", file("reference.csv")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| 3 returns | value |"));
  EXPECT_THAT(result.out, HasSubstr("| beams within 0.1 | 0.33 |"));  // the one ahead
}

TEST_F(EvaluateLogEndToEnd, SaysWhatIsMissing) {
  EXPECT_EQ(evaluate({"--log", file("drive.log"), "--reference", file("reference.csv")}).exit_code,
            2);
  EXPECT_EQ(evaluate({"--log", file("drive.log"), "--map", file("drawing.pgm")}).exit_code, 2);
  EXPECT_EQ(evaluate({"--trajectory", file("estimate.tum")}).exit_code, 2);
  EXPECT_EQ(evaluate({"--trajectory", file("estimate.tum"), "--reference", file("reference.tum"),
                      "--relations", file("drive.relations")})
                .exit_code,
            2);
}

}  // namespace
}  // namespace sketchloc

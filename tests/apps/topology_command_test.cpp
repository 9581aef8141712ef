#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "datasets/io/g2o_io.hpp"
#include "datasets/io/labels_io.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "tests/support/aisle_drive.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::CommandResult;
using testing::content_of;
using ::testing::HasSubstr;

MetricTrajectory in_seconds(const std::vector<Se2>& poses) {
  MetricTrajectory trajectory;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    trajectory.append(static_cast<double>(i), poses[i]);
  }
  return trajectory;
}

class TopologyEndToEnd : public ::testing::Test {
 protected:
  void SetUp() override {
    Rng rng = make_rng(1);
    const auto drive = testing::aisle_drive({.aisles = 4, .drift_deg_per_m = 1.0}, rng);
    poses_ = drive.labels.size();
    write_tum(folder_ / "odometry.tum", in_seconds(drive.odom_from_robot));
    write_tum(folder_ / "truth.tum", in_seconds(drive.world_from_robot));
    write_labels(folder_ / "labels.csv", drive.labels);
  }

  CommandResult topology(const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM, "topology",
                                        "--trajectory",    folder_ / "odometry.tum",
                                        "--labels",        folder_ / "labels.csv",
                                        "--out",           folder_ / "out",
                                        "--force"};
    command.insert(command.end(), flags.begin(), flags.end());
    return testing::run_command(command);
  }
  nlohmann::json metrics() const {
    return nlohmann::json::parse(content_of(folder_ / "out/metrics.json"));
  }
  double rmse_m() const { return metrics()["ate_m"]["se2"]["rmse"]; }

  testing::TemporaryDirectory folder_;
  std::size_t poses_ = 0;
};

TEST_F(TopologyEndToEnd, WritesTheRunItsGraphItsFiguresAPictureAndHowTheyWereMade) {
  const CommandResult result = topology({"--reference", folder_ / "truth.tum"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("laid onto it, RMSE"));
  EXPECT_EQ(read_tum(folder_ / "out/trajectory.tum").size(), poses_);
  EXPECT_EQ(read_g2o(folder_ / "out/graph.g2o").vertices.size(), poses_);
  EXPECT_LT(rmse_m(), 0.5);
  EXPECT_GT(metrics()["odometry_ate_m"]["se2"]["rmse"], 2.0);
  EXPECT_EQ(metrics()["same_place"]["used"], metrics()["same_place"]["right"]);
  for (const char* file : {"nodes.csv", "pairs.csv"}) {
    EXPECT_THAT(content_of(folder_ / "out" / file), HasSubstr("\n0,"));
  }
  EXPECT_THAT(content_of(folder_ / "out/picture.png"), HasSubstr("PNG"));
  EXPECT_THAT(content_of(folder_ / "out/run.yaml"), HasSubstr("command: topology"));
}

TEST_F(TopologyEndToEnd, GrowsTheRunToTheSameEnd) {
  ASSERT_EQ(topology({"--reference", folder_ / "truth.tum", "--incremental"}).exit_code, 0);
  EXPECT_LT(rmse_m(), 0.5);
  EXPECT_GT(metrics()["updates"], 10);
  EXPECT_TRUE(metrics().contains("online_ate_m"));
}

TEST_F(TopologyEndToEnd, NeedsNoReference) {
  ASSERT_EQ(topology().exit_code, 0);
  EXPECT_FALSE(metrics().contains("ate_m"));
}

TEST_F(TopologyEndToEnd, StopsAtTheStageThatIsAskedFor) {
  ASSERT_EQ(topology({"--stage", "unoptimised", "--reference", folder_ / "truth.tum"}).exit_code,
            0);
  EXPECT_GT(rmse_m(), 2.0);
  EXPECT_EQ(topology({"--stage", "snap", "--incremental"}).exit_code, 2);
  EXPECT_THAT(topology({"--stage", "best"}).err, HasSubstr("feedback"));
}

TEST_F(TopologyEndToEnd, RefusesLabelsAndReferencesOfAnotherRun) {
  std::ofstream(folder_ / "labels.csv") << "index,label_name\n0,corridor\n";
  CommandResult result = topology();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("labels.csv: 1 entries"), HasSubstr("odometry.tum has")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));

  SetUp();
  std::ofstream(folder_ / "truth.tum") << "0 0 0 0 0 0 0 1\n";
  result = topology({"--reference", folder_ / "truth.tum"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("truth.tum: 1 entries"));
}

TEST_F(TopologyEndToEnd, RefusesAReferenceAtOtherTimes) {
  MetricTrajectory later;
  for (const Stamped<Se2>& stamped : read_tum(folder_ / "truth.tum")) {
    later.append(stamped.time_s + 1e6, stamped.pose);
  }
  write_tum(folder_ / "truth.tum", later);
  const CommandResult result = topology({"--reference", folder_ / "truth.tum"});
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("time"));
}

TEST_F(TopologyEndToEnd, SaysWhereARunHasNothingStraight) {
  write_tum(folder_ / "odometry.tum", in_seconds({Se2(), Se2::from_xy_yaw(0.1, 0.0, 0.0)}));
  write_labels(folder_ / "labels.csv", {PlaceLabel::Corridor, PlaceLabel::Corridor});
  const CommandResult result = topology();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("never drove straight on"));
}

class WarehouseEndToEnd : public ::testing::TestWithParam<const char*> {};

TEST_P(WarehouseEndToEnd, IsRecoveredWithinHalfAMetre) {
  const auto run = testing::shared_data(std::filesystem::path("warehouse") / GetParam());
  if (!run) {
    GTEST_SKIP() << "no warehouse runs in $SKETCHLOC_DATA";
  }
  const testing::TemporaryDirectory folder;
  for (const std::vector<std::string>& how : {std::vector<std::string>{}, {"--incremental"}}) {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM,  "topology",      "--trajectory",
                                        *run / "unopt.tum", "--labels",      *run / "labels.csv",
                                        "--reference",      *run / "gt.tum", "--out",
                                        folder / "out",     "--force"};
    command.insert(command.end(), how.begin(), how.end());
    const CommandResult result = testing::run_command(command);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto figures = nlohmann::json::parse(content_of(folder / "out/metrics.json"));
    EXPECT_LT(figures["ate_m"]["se2"]["rmse"], 0.5);
    EXPECT_LT(figures["ate_m"]["unaligned"]["mean"], 0.8);
  }
}

INSTANTIATE_TEST_SUITE_P(Warehouse, WarehouseEndToEnd, ::testing::Values("W-1.1", "W-2.1"),
                         [](const auto& run) {
                           return std::string(run.param) == "W-1.1" ? "First" : "Second";
                         });

class TopologyOfALogEndToEnd : public ::testing::Test {
 protected:
  void SetUp() override {
    const CommandResult made =
        testing::run_command({SKETCHLOC_PROGRAM, "generate", "--quiet", "--kind", "warehouse",
                              "--seed", "4", "--drive.length_m", "60", "--out", folder_ / "run"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }

  CommandResult topology(const std::vector<std::string>& flags) const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM, "topology", "--out", folder_ / "out",
                                        "--force"};
    command.insert(command.end(), flags.begin(), flags.end());
    return testing::run_command(command);
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(TopologyOfALogEndToEnd, TellsKindsOfPlacesAndClosesLoopsByScans) {
  const CommandResult result =
      topology({"--log", folder_ / "run/log.jsonl", "--reference", folder_ / "run/truth.tum",
                "--reference-labels", folder_ / "run/labels.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("kinds of places: "));
  const nlohmann::json metrics = nlohmann::json::parse(content_of(folder_ / "out/metrics.json"));
  EXPECT_GT(metrics["labels"]["accuracy"], 0.7);
  EXPECT_LT(metrics["ate_m"]["se2"]["rmse"], 0.5);
  EXPECT_EQ(read_labels(folder_ / "out/labels.csv").size(), metrics["poses"]);
}

TEST_F(TopologyOfALogEndToEnd, TakesLabelsAndRawOdometryWhereTheyAreGiven) {
  const CommandResult result = topology({"--log", folder_ / "run/log.jsonl", "--labels",
                                         folder_ / "run/labels.csv", "--odometry", "raw"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/labels.csv"));
  EXPECT_THAT(content_of(folder_ / "out/run.yaml"), HasSubstr("odometry: raw"));
}

TEST_F(TopologyOfALogEndToEnd, SaysWhatBelongsTogether) {
  const std::string log = folder_ / "run/log.jsonl";
  EXPECT_THAT(topology({}).err, HasSubstr("--log"));
  EXPECT_THAT(topology({"--log", log, "--trajectory", folder_ / "run/truth.tum"}).err,
              HasSubstr("one of the two"));
  EXPECT_THAT(topology({"--trajectory", folder_ / "run/truth.tum"}).err, HasSubstr("--labels"));
  const CommandResult result = topology({"--log", log, "--network", log});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("log.jsonl: no network"), HasSubstr("--network places")));
}

}  // namespace
}  // namespace sketchloc

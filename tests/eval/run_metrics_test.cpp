#include "eval/run_metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

SketchErrors some_errors() {
  const ErrorSummary summary{
      .mean = 1.0, .median = 0.5, .rmse = 1.5, .p90 = 2.0, .max = 3.0, .count = 4};
  SketchErrors errors;
  errors.scored = 4;
  errors.share_within_1_m = 0.75;
  errors.share_within_2_m = 1.0;
  errors.translation_m = errors.translation_px = errors.heading_rad = summary;
  return errors;
}

void expect_five_numbers(const json& object) {
  for (const char* key : {"mean", "median", "rmse", "p90", "max"}) {
    EXPECT_TRUE(object.at(key).is_number()) << key;
  }
}

TEST(RunMetricsJson, HasTheKeysThatScriptsRead) {
  const RunMetrics metrics{
      .poses = 9, .errors = some_errors(), .cost = RunCost{.seconds = 2.5, .peak_memory_mb = 40.0}};
  const json parsed = json::parse(to_json(metrics));
  EXPECT_DOUBLE_EQ(parsed.at("share_within_1_m"), 0.75);
  EXPECT_DOUBLE_EQ(parsed.at("share_within_2_m"), 1.0);
  expect_five_numbers(parsed.at("translation_error_m"));
  expect_five_numbers(parsed.at("heading_error_deg"));
  EXPECT_NEAR(parsed.at("heading_error_deg").at("median"), 28.64788975654116, 1e-12);
  EXPECT_EQ(parsed.at("lost_at_end"), false);
  EXPECT_TRUE(parsed.at("first_loss_s").is_null());
  EXPECT_EQ(parsed.at("poses"), 9);
  EXPECT_DOUBLE_EQ(parsed.at("seconds"), 2.5);
  EXPECT_DOUBLE_EQ(parsed.at("peak_memory_mb"), 40.0);
}

TEST(RunMetricsJson, HasTheSameKeysWithNullWhereThereWasNoReference) {
  const json full =
      json::parse(to_json(RunMetrics{.poses = 9, .errors = some_errors(), .cost = {}}));
  for (const std::optional<SketchErrors>& nothing :
       {std::optional<SketchErrors>(), std::optional(SketchErrors{})}) {
    const json parsed = json::parse(to_json(RunMetrics{.poses = 9, .errors = nothing, .cost = {}}));
    EXPECT_EQ(parsed.size(), full.size());
    for (const auto& [key, value] : full.items()) {
      ASSERT_TRUE(parsed.contains(key)) << key;
      EXPECT_TRUE(parsed.at(key).is_null() || key == "poses" || key == "scored_poses") << key;
    }
    EXPECT_EQ(parsed.at("poses"), 9);
    EXPECT_EQ(parsed.at("scored_poses"), 0);
  }
}

class ReadRunErrors : public ::testing::Test {
 protected:
  SketchErrors read(const std::string& text) const {
    std::ofstream(folder_ / "metrics.json") << text;
    return read_run_errors(folder_ / "metrics.json");
  }
  void fails_with(const std::string& text, const std::string& message) const {
    EXPECT_THAT([&] { read(text); },
                ThrowsMessage<std::runtime_error>(HasSubstr("metrics.json: " + message)));
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(ReadRunErrors, GivesWhatWasWritten) {
  SketchErrors written = some_errors();
  written.first_loss_s = 12.5;
  written.lost_at_end = true;
  const SketchErrors errors = read(to_json(RunMetrics{.poses = 9, .errors = written, .cost = {}}));
  EXPECT_EQ(errors.scored, 4U);
  EXPECT_EQ(errors.share_within_1_m, 0.75);
  EXPECT_EQ(errors.share_within_2_m, 1.0);
  EXPECT_EQ(errors.translation_m->median, 0.5);
  EXPECT_NEAR(errors.heading_rad->median, 0.5, 1e-15);
  EXPECT_EQ(errors.first_loss_s, 12.5);
  EXPECT_TRUE(errors.lost_at_end);
}

TEST_F(ReadRunErrors, SaysWhatIsMissingOrWrong) {
  EXPECT_THROW(read_run_errors(folder_ / "none.json"), std::runtime_error);
  fails_with("no json", "is not the metrics.json of a run");
  fails_with("[1]", "is not the metrics.json of a run");
  fails_with("{}", "share_within_1_m is missing");
  fails_with(to_json(RunMetrics{.poses = 9, .errors = {}, .cost = {}}),
             "share_within_1_m is null: the run was compared with nothing");
  fails_with(R"({"share_within_1_m": "all"})", "share_within_1_m must be a number");
}

TEST(TrajectoryMetricsJson, HasTheAbsoluteErrorsOfEveryAlignment) {
  MetricTrajectory reference;
  MetricTrajectory estimate;
  for (const double x : {0.0, 1.0, 2.0}) {
    reference.append(x, Se2::from_xy_yaw(x, 0.0, 0.0));
    estimate.append(x, Se2::from_xy_yaw(x, 2.0, 0.0));
  }
  const TrajectoryMetrics metrics =
      measure_trajectory(reference, estimate, 0.01, {{.delta = PathDelta{.path_m = 1.0}}});
  const json parsed = json::parse(to_json(metrics));
  for (const char* alignment : {"unaligned", "first_pose", "se2", "sim2"}) {
    expect_five_numbers(parsed.at("ate_m").at(alignment));
  }
  EXPECT_NEAR(parsed.at("ate_m").at("unaligned").at("rmse"), 2.0, 1e-12);
  EXPECT_NEAR(parsed.at("ate_m").at("first_pose").at("max"), 0.0, 1e-12);
  EXPECT_EQ(parsed.at("matched_poses"), 3);
  EXPECT_EQ(parsed.at("rpe").at(0).at("pairs"), 2);
}

TEST(TrajectoryMetricsJson, IsNullWhereNoTimesMatch) {
  MetricTrajectory reference;
  reference.append(0.0, Se2());
  MetricTrajectory estimate;
  estimate.append(5.0, Se2());
  const json parsed = json::parse(to_json(measure_trajectory(reference, estimate, 0.01, {})));
  EXPECT_TRUE(parsed.at("ate_m").at("se2").is_null());
  EXPECT_EQ(parsed.at("matched_poses"), 0);
}

}  // namespace
}  // namespace sketchloc

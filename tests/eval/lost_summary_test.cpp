#include "eval/lost_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "eval/lost_drives.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;

struct Moment {
  double error_m = 0.0;
  double probability = 1.0;
};

/// A metre and a second a step.
FilterTrial trial_of(const std::vector<Moment>& moments) {
  FilterTrial trial{.set = "set", .kind = "kind", .method = "mcl", .seed = 1, .errors = {}};
  for (std::size_t i = 0; i < moments.size(); ++i) {
    StepError error;
    error.step = i;
    error.time_s = error.driven_m = static_cast<double>(i);
    error.translation_m = moments[i].error_m;
    error.localized_probability = moments[i].probability;
    error.stated_sigma_m = 0.1;
    trial.errors.push_back(error);
  }
  return trial;
}

TEST(LostSummary, ComparesStatedProbabilitiesWithWhatWasRight) {
  const std::vector<LostRow> rows =
      summarize_lost({{trial_of({{0.0, 0.95}, {0.0, 0.85}, {9.0, 0.95}, {9.0, 0.05}})}});
  ASSERT_EQ(rows.size(), 2U);  // the kind and all
  const Reliability& reliability = rows[0].reliability;
  EXPECT_EQ(reliability.count, 4U);
  EXPECT_NEAR(reliability.share_right, 0.5, 1e-12);
  EXPECT_NEAR(reliability.brier, (0.05 * 0.05 + 0.15 * 0.15 + 0.95 * 0.95 + 0.05 * 0.05) / 4.0,
              1e-12);
  EXPECT_NEAR(reliability.brier_of_rate, 0.25, 1e-12);
  // Of four pairs two are in order, one is a tie, one is reversed.
  EXPECT_NEAR(reliability.area, 2.5 / 4.0, 1e-12);
  ASSERT_EQ(reliability.bins.size(), 3U);
  EXPECT_EQ(reliability.bins[2].count, 2U);
  EXPECT_NEAR(reliability.bins[2].share_right, 0.5, 1e-12);
}

TEST(LostSummary, CountsAlarmsThatAreRaisedWhileRight) {
  const std::vector<LostRow> rows = summarize_lost({{trial_of(
      {{0.0, 0.9}, {0.0, 0.05}, {0.0, 0.05}, {0.0, 0.9}, {9.0, 0.05}, {9.0, 0.9}, {0.0, 0.9}})}});
  const auto alarm = std::ranges::find(rows[0].alarms, 0.1, &AlarmPoint::threshold);
  // One alarm in the 4 s of being right, and 1 s of the 2 s of being wrong under one.
  EXPECT_NEAR(alarm->false_per_hour, 3600.0 / 4.0, 1e-9);
  EXPECT_NEAR(*alarm->wrong_share, 0.5, 1e-12);
  EXPECT_FALSE(alarm->noticed.has_value());
}

TEST(LostSummary, SaysHowSoonACarriedRobotNoticesAndIsFound) {
  FilterTrial noticed = trial_of({{0.0, 0.9}, {9.0, 0.9}, {9.0, 0.05}, {9.0, 0.9}, {0.0, 0.9}});
  noticed.carried_at = 1;
  FilterTrial missed = trial_of({{0.0, 0.9}, {9.0, 0.9}, {9.0, 0.9}});
  missed.carried_at = 1;
  FilterTrial lost_before = trial_of({{9.0, 0.9}, {9.0, 0.01}});
  lost_before.carried_at = 1;
  const std::vector<LostRow> rows =
      summarize_lost(std::vector<FilterTrial>{noticed, missed, lost_before}, {.found_way_m = 20.0});
  const auto alarm = std::ranges::find(rows[0].alarms, 0.1, &AlarmPoint::threshold);
  EXPECT_NEAR(*alarm->noticed, 0.5, 1e-12);
  EXPECT_EQ(rows[0].events, 2U);
  EXPECT_EQ(rows[0].found, 1U);
  EXPECT_NEAR(*rows[0].median_found_way_m, 3.0, 1e-12);
}

TEST(LostSummary, FindsTheWayAfterWhichTheRobotStaysRight) {
  const FilterTrial trial =
      trial_of({{9.0}, {0.0}, {0.0}, {9.0}, {0.0}, {0.0}, {0.0}, {0.0}, {9.0}});
  EXPECT_EQ(found_after_m(trial.errors, {.found_lasting_m = 3.0}), 4.0);
  EXPECT_EQ(found_after_m(trial.errors, {.found_lasting_m = 1.0}), 1.0);
  EXPECT_EQ(found_after_m(trial.errors, {.found_lasting_m = 4.0}), std::nullopt);
}

TEST(LostSummary, IsWrittenAsJsonAndTable) {
  const std::vector<LostRow> rows = summarize_lost({{trial_of({{0.0, 0.95}, {9.0, 0.05}})}});
  EXPECT_EQ(nlohmann::json::parse(lost_json(rows))[1]["kind"], "all");
  EXPECT_THAT(lost_markdown(rows), HasSubstr("| kind | mcl | 1 | 50 |"));
}

TEST(LostDrives, CarryTheRobotWhileTheOdometryGoesOn) {
  const auto drive = [](double x_m) {
    FilterData data;
    for (std::size_t i = 0; i < 3; ++i) {
      Scan scan;
      scan.time_s = 5.0 + static_cast<double>(i);
      const double way_m = x_m + static_cast<double>(i);
      data.run.steps.push_back({scan, Se2::from_xy_yaw(way_m, 0.0, 0.0)});
      data.reference.poses.push_back(
          {.step = i,
           .time_s = scan.time_s,
           .sketch_from_robot = Sim2::from_xy_yaw_scale(10.0 * x_m, 0.0, 0.0, 10.0)});
    }
    return data;
  };
  const FilterData both = carried(drive(0.0), drive(50.0));
  ASSERT_EQ(both.run.steps.size(), 6U);
  EXPECT_EQ(both.carried_at, 3U);
  EXPECT_EQ(both.reference.poses[3].step, 3U);
  EXPECT_EQ(both.run.steps[3].odom_from_robot.translation().x(), 2.0);  // it does not notice
  EXPECT_EQ(both.run.steps[4].odom_from_robot.translation().x(), 3.0);
  EXPECT_EQ(both.run.steps[3].scan.time_s, 8.0);
  EXPECT_EQ(both.reference.poses[3].sketch_from_robot.x(), 500.0);
}

}  // namespace
}  // namespace sketchloc

#include "eval/planning_suite.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sketchloc {
namespace {

PlanningTrial trial(int query, const std::string& method, double length_m, double clearance_m) {
  PlanningTrial one{.query = query, .method = method, .found = length_m > 0.0};
  one.figures.length_m = length_m;
  one.figures.least_clearance_m = clearance_m;
  one.first_length_m = length_m;
  one.first_ms = 2.0 * length_m;
  return one;
}

TEST(PlanningSuite, ComparesWithTheBaselineQuestionByQuestion) {
  const std::vector<PlanningTrial> trials = {
      trial(0, kPlanningBaseline, 10.0, 0.2), trial(0, "balanced", 11.0, 0.5),
      trial(1, kPlanningBaseline, 20.0, 0.2), trial(1, "balanced", 26.0, 0.3),
      trial(2, kPlanningBaseline, 20.0, 0.2), trial(2, "balanced", 0.0, 0.0)};
  const auto rows = nlohmann::json::parse(planning_suite_json(trials, 1))["rows"];
  const auto& row = rows[1];
  EXPECT_EQ(row["method"], "balanced");
  EXPECT_EQ(row["questions"], 3);
  EXPECT_EQ(row["found"], 2);
  EXPECT_EQ(row["missed"], 1);
  EXPECT_NEAR(row["length_ratio"]["mean"], 1.2, 1e-12);  // of 1.1 and 1.3
  EXPECT_NEAR(row["least_clearance_gain_m"]["mean"], 0.2, 1e-12);
  EXPECT_NEAR(row["first_ms_median"], 37.0, 1e-9);
  EXPECT_THAT(planning_suite_markdown(trials, 1), ::testing::HasSubstr("| 2/3 | 1 | 1.2000"));
}

TEST(PlanningSuite, AsksTheSameQuestionsOfAll) {
  const PlanningSuiteParams suite{.drawings = 1, .queries = 2, .deadline_ms = 5.0};
  double now_s = 0.0;
  const auto trials =
      ask_about_drawing(0, suite, {}, 3, [&] { return now_s += 1e-4; });  // a clock of its own
  ASSERT_EQ(trials.size(), 8U);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(trials[i].query, static_cast<int>(i / 4));
    EXPECT_EQ(trials[i].found, trials[i / 4 * 4].found);
  }
}

}  // namespace
}  // namespace sketchloc

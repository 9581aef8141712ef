#include "eval/filter_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sketchloc {
namespace {

using ::testing::HasSubstr;

/// A metre a step; the error at each of them.
FilterTrial trial_of(const std::string& set, const std::string& method, std::uint64_t seed,
                     const std::vector<double>& errors_m) {
  FilterTrial trial{.set = set, .kind = "kind", .method = method, .seed = seed, .errors = {}};
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    StepError error;
    error.step = i;
    error.driven_m = static_cast<double>(i);
    error.translation_m = errors_m[i];
    error.heading_rad = 0.1;
    error.position_nees = 1.0;
    error.stated_sigma_m = 0.1;
    trial.errors.push_back(error);
  }
  return trial;
}

std::vector<FilterTrial> two_methods() {
  return {trial_of("a", "good", 1, {0.5, 0.5, 0.5, 1.5}),
          trial_of("a", "good", 2, {0.5, 0.5, 0.5, 0.5}),
          trial_of("b", "good", 1, {1.0, 1.0, 1.0, 1.0}),
          trial_of("a", "bad", 1, {0.5, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0}),
          trial_of("b", "bad", 1, {2.5, 2.5, 2.5, 2.5})};
}

TEST(FilterSummary, PoolsTheRunsOfAMethod) {
  const std::vector<FilterRow> rows = summarize_filter(two_methods());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].method, "good");
  EXPECT_EQ(rows[0].sets, 2U);
  EXPECT_EQ(rows[0].trials, 3U);
  EXPECT_NEAR(rows[0].mean_error_m.mean, (0.75 + 0.5 + 1.0) / 3.0, 1e-12);
  EXPECT_NEAR(rows[0].share_within_1_m.mean, (0.75 + 1.0 + 1.0) / 3.0, 1e-12);
  EXPECT_NEAR(rows[0].share_ever_lost.mean, 0.0, 1e-12);
  EXPECT_NEAR(rows[1].share_ever_lost.mean, 0.5, 1e-12);
  EXPECT_NEAR(rows[1].share_lost_at_end.mean, 0.5, 1e-12);
  EXPECT_EQ(rows[1].nees_inside_95, 1.0);
}

TEST(FilterSummary, SurvivalFallsWhereRunsAreLostAndCountsThoseThatEnd) {
  // One run is lost after 1 m, the other ends unharmed after 3 m.
  const std::vector<FilterRow> rows = summarize_filter(two_methods());
  const auto& curve = rows[1].survival;
  EXPECT_EQ(curve.front(), (std::pair(0.0, 1.0)));
  EXPECT_EQ(curve.back().second, 0.5);
  EXPECT_EQ(curve[1].first, 1.0);
  EXPECT_EQ(rows[0].survival.back().second, 1.0);
}

TEST(FilterSummary, ComparesOnTheSameRuns) {
  const std::vector<FilterDifference> differences = compare_filter(two_methods(), "good");
  ASSERT_EQ(differences.size(), 1U);
  const double on_a = 0.625 - (0.5 + 7 * 9.0) / 8.0;  // over both seeds of the first
  const double on_b = 1.0 - 2.5;
  EXPECT_NEAR(differences[0].mean_error_m.mean, 0.5 * (on_a + on_b), 1e-12);
}

TEST(FilterSummary, IsWrittenAsJsonTableAndPage) {
  const std::vector<FilterTrial> trials = two_methods();
  const auto rows = summarize_filter(trials);
  const auto differences = compare_filter(trials, "good");
  const auto json = nlohmann::json::parse(filter_json(rows, differences));
  EXPECT_EQ(json["rows"][1]["method"], "bad");
  EXPECT_THAT(filter_markdown(rows), HasSubstr("| kind | good | 3 | 75 ["));
  EXPECT_THAT(filter_page_html("T", "<c>", rows, differences), HasSubstr("&lt;c&gt;"));
}

TEST(FilterTrial, SurvivesItsJson) {
  FilterTrial trial = trial_of("set", "mcl", 7, {0.1, 0.2});
  trial.errors[1].position_nees = std::nullopt;
  const FilterTrial back = trial_from_json(trial_json(trial));
  EXPECT_EQ(back.set, "set");
  EXPECT_EQ(back.seed, 7U);
  ASSERT_EQ(back.errors.size(), 2U);
  EXPECT_EQ(back.errors[1].translation_m, 0.2);
  EXPECT_FALSE(back.errors[1].position_nees.has_value());
  EXPECT_THROW(trial_from_json("{}"), std::runtime_error);
  EXPECT_THROW(trial_from_json("no"), std::runtime_error);
}

}  // namespace
}  // namespace sketchloc

#include "eval/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/markup.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

SketchErrors run_with(double share, std::optional<double> first_loss_s) {
  const ErrorSummary summary{
      .mean = share, .median = share, .rmse = share, .p90 = share, .max = share, .count = 1};
  SketchErrors errors;
  errors.scored = 1;
  errors.share_within_1_m = errors.share_within_2_m = share;
  errors.translation_m = errors.heading_rad = summary;
  errors.first_loss_s = first_loss_s;
  errors.lost_at_end = first_loss_s.has_value();
  return errors;
}

RunSet some_runs() {
  return {.data_set = "a <house> | b",
          .method = "mcl",
          .runs = {run_with(0.5, 10.0), run_with(0.7, std::nullopt), run_with(0.6, 30.0)}};
}

TEST(ResultTable, AveragesTheRunsOfASet) {
  const std::vector<RunSet> sets = {some_runs()};
  const auto rows = summarize_runs(sets);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].runs, 3U);
  EXPECT_NEAR(rows[0].share_within_2_m.value.value(), 0.6, 1e-12);
  EXPECT_GE(rows[0].share_within_2_m.interval->low, 0.5);
  EXPECT_LE(rows[0].share_within_2_m.interval->high, 0.7);
  EXPECT_NEAR(rows[0].first_loss_s.value.value(), 30.0, 1e-12);  // 10, 30, never
  EXPECT_NEAR(rows[0].worst_within_2_m.value.value(), 0.5, 1e-12);
  EXPECT_NEAR(rows[0].share_lost_at_end.value.value(), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(rows[0].share_lost_at_end.interval->low, 0.2077, 1e-3);  // Wilson, worked by hand
  EXPECT_NEAR(rows[0].share_lost_at_end.interval->high, 0.9385, 1e-3);
}

TEST(ResultTable, SaysNeverWhereMostRunsAreNeverLost) {
  const std::vector<RunSet> sets = {
      {.data_set = "d",
       .method = "m",
       .runs = {run_with(0.9, {}), run_with(0.9, 5.0), run_with(0.9, {})}}};
  EXPECT_FALSE(summarize_runs(sets)[0].first_loss_s.value.has_value());
  EXPECT_THAT(table_markdown(summarize_runs(sets)), HasSubstr("| never |"));
}

TEST(ResultTable, LeavesOutSetsWithoutRuns) {
  const std::vector<RunSet> sets = {{.data_set = "d", .method = "m", .runs = {}}};
  EXPECT_TRUE(summarize_runs(sets).empty());
}

TEST(ResultTable, HasNoIntervalForOneRun) {
  const std::vector<RunSet> sets = {{.data_set = "d", .method = "m", .runs = {run_with(0.5, {})}}};
  EXPECT_FALSE(summarize_runs(sets)[0].share_within_1_m.interval.has_value());
}

TEST(ResultTable, AsMarkdownKeepsItsColumns) {
  const std::vector<RunSet> sets = {some_runs()};
  const std::string text = table_markdown(summarize_runs(sets));
  EXPECT_THAT(text, HasSubstr("| a <house> \\| b | mcl | 3 | 60 ["));
}

TEST(ResultTable, AsHtmlIsWellFormedAndEscaped) {
  const std::vector<RunSet> sets = {some_runs()};
  const std::string html = table_html("Title & more", "caption <b>", summarize_runs(sets));
  EXPECT_THAT(testing::markup_faults(html), IsEmpty());
  EXPECT_THAT(html, HasSubstr("a &lt;house&gt; | b"));
  EXPECT_THAT(html, Not(HasSubstr("http:")));
}

}  // namespace
}  // namespace sketchloc

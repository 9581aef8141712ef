#include "eval/detail/moments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/eval/synthetic_run.hpp"

namespace sketchloc::detail {
namespace {

using ::testing::HasSubstr;
using testing::make_synthetic_run;
using testing::Outcome;

const Moment* with_reason(const std::vector<Moment>& moments, const std::string& reason) {
  const auto it = std::ranges::find_if(
      moments, [&](const Moment& m) { return m.reason.find(reason) != std::string::npos; });
  return it == moments.end() ? nullptr : &*it;
}

TEST(Moments, ShowTheLargestErrorAndTheLossInOrderOfTime) {
  const RunRecord record = make_synthetic_run(Outcome::Recovered);
  const auto errors = step_errors(record);
  const auto moments = choose_moments(record, errors, 4);
  ASSERT_EQ(moments.size(), 6U);
  EXPECT_TRUE(std::ranges::is_sorted(moments, {}, &Moment::index));
  EXPECT_EQ(moments.front().letter, "A");
  EXPECT_EQ(moments.back().letter, "F");
  const Moment* worst = with_reason(moments, "largest error");
  ASSERT_NE(worst, nullptr);
  EXPECT_EQ(worst->error->translation_m,
            std::ranges::max(errors, {}, &StepError::translation_m).translation_m);
  const Moment* loss = with_reason(moments, "first lost");
  ASSERT_NE(loss, nullptr);
  EXPECT_EQ(record.steps[loss->index].step, first_loss(errors)->step);
}

TEST(Moments, BeginWithTheFirstStepAndEndWithTheLast) {
  const RunRecord record = make_synthetic_run(Outcome::Recovered);
  const auto moments = choose_moments(record, step_errors(record), 4);
  EXPECT_EQ(moments.front().index, 0U);
  EXPECT_GT(moments.back().index, record.steps.size() * 9 / 10);
}

TEST(Moments, WithoutAReferenceShowTheLeastCertainStep) {
  RunRecord record = make_synthetic_run(Outcome::Located);
  record.reference.reset();
  const auto moments = choose_moments(record, {}, 4);
  EXPECT_NE(with_reason(moments, "least certain"), nullptr);
}

TEST(Moments, OfAShortRunAreItsSteps) {
  RunRecord record = make_synthetic_run(Outcome::Located);
  record.steps.resize(2);
  EXPECT_EQ(choose_moments(record, step_errors(record), 4).size(), 2U);
  record.steps.clear();
  EXPECT_TRUE(choose_moments(record, {}, 4).empty());
}

TEST(Moments, ThatLookTheSameAreOne) {
  RunRecord record = make_synthetic_run(Outcome::Located);
  std::vector<StepError> errors = step_errors(record);
  for (StepError& error : errors) {
    error.translation_m = 0.0;
  }
  (errors.end() - 2)->translation_m = 4.0;  // lost at the end, and worst one step later
  errors.back().translation_m = 5.0;
  const auto moments = choose_moments(record, errors, 0);
  ASSERT_EQ(moments.size(), 1U);
  EXPECT_EQ(moments.front().reason, "first lost, largest error");
}

TEST(Moments, BetweenTheNotableOnesHaveParticlesWhereTheyCan) {
  RunRecord record = make_synthetic_run(Outcome::Located);
  record.snapshots.clear();
  for (std::size_t index = 2; index < record.steps.size(); index += 5) {
    record.snapshots.push_back({.step = record.steps[index].step, .particles = {}});
  }
  for (const Moment& moment : choose_moments(record, step_errors(record), 4)) {
    if (moment.reason.empty()) {
      EXPECT_EQ(moment.index % 5, 2U);
    }
  }
}

TEST(NearestSnapshot, IsTheOneTakenClosest) {
  RunRecord record;
  EXPECT_EQ(nearest_snapshot(record, 3), nullptr);
  record.snapshots = {{.step = 0, .particles = {}}, {.step = 10, .particles = {}}};
  EXPECT_EQ(nearest_snapshot(record, 6)->step, 10U);
  EXPECT_EQ(nearest_snapshot(record, 4)->step, 0U);
}

}  // namespace
}  // namespace sketchloc::detail

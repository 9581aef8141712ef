#include "filter/online/budget_policy.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace sketchloc {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

/// 1 us a particle, 10 ms a registration, 5 ms of odometry, times `slowness`.
StepCost cost_of(const StepPlan& plan, double slowness, bool due) {
  const bool looked = due && plan.budget.may_register;
  const std::size_t particles = std::min<std::size_t>(plan.budget.max_particles, 8000);
  return {.before_s = 0.005 * slowness,
          .localizer_s = slowness * (1e-6 * static_cast<double>(particles) + (looked ? 0.01 : 0.0)),
          .particles = particles,
          .updated = true,
          .looked = looked};
}

double total_s(const StepCost& cost) { return cost.before_s + cost.localizer_s; }

TEST(BudgetPolicy, AllowsEverythingWithoutADeadline) {
  BudgetPolicy policy({}, std::nullopt);
  policy.learn({.before_s = 10.0, .localizer_s = 10.0, .particles = 10, .updated = true});
  EXPECT_EQ(policy.plan(100.0), StepPlan{});
}

TEST(BudgetPolicy, AllowsEverythingUntilItKnowsWhatStepsTake) {
  BudgetPolicy policy({}, 0.05);
  EXPECT_EQ(policy.plan(0.0), StepPlan{});
}

TEST(BudgetPolicy, TakesNothingAwayWhereThereIsTime) {
  BudgetPolicy policy({.planned_share = 0.8}, 0.05);
  for (int i = 0; i < 50; ++i) {
    const StepPlan plan = policy.plan(0.0);
    EXPECT_TRUE(plan.budget.may_register);
    EXPECT_EQ(plan.register_every, 1);
    EXPECT_GE(plan.budget.max_particles, 8000U);
    policy.learn(cost_of(plan, 1.0, true));
  }
}

TEST(BudgetPolicy, TakesParticlesFirst) {
  BudgetPolicy policy({.planned_share = 0.8, .min_particles = 1000}, 0.05);
  StepPlan plan;
  for (int i = 0; i < 50; ++i) {
    plan = policy.plan(0.0);
    policy.learn(cost_of(plan, 2.0, i % 2 == 0));
  }
  EXPECT_TRUE(plan.budget.may_register);
  EXPECT_EQ(plan.register_every, 1);
  EXPECT_LT(plan.budget.max_particles, 8000U);
  EXPECT_GE(plan.budget.max_particles, 1000U);
  EXPECT_LE(total_s(cost_of(plan, 2.0, true)), 0.041);
}

TEST(BudgetPolicy, ThenRegistersAtEveryNthScanOnly) {
  BudgetPolicy policy({.planned_share = 0.8, .min_particles = 1000}, 0.05);
  int registrations = 0;
  int every = 1;
  for (int i = 0; i < 200; ++i) {
    const StepPlan plan = policy.plan(0.0);
    const StepCost cost = cost_of(plan, 4.0, true);
    registrations += i >= 100 && cost.looked ? 1 : 0;
    every = plan.register_every;
    EXPECT_GE(plan.budget.max_particles, 1000U);
    policy.learn(cost);
  }
  EXPECT_GT(every, 1);
  EXPECT_LE(every, 50);
  EXPECT_NEAR(registrations, 100.0 / every, 1.0);
}

TEST(BudgetPolicy, TriesARegistrationNowAndThenEvenIfNothingFits) {
  BudgetPolicy policy({.rarest = 20}, 0.05);
  int registrations = 0;
  for (int i = 0; i < 200; ++i) {
    const StepCost cost = cost_of(policy.plan(0.0), 100.0, true);
    registrations += cost.looked ? 1 : 0;
    policy.learn(cost);
  }
  EXPECT_GE(registrations, 10);
  EXPECT_LE(registrations, 13);
}

TEST(BudgetPolicy, GivesEverythingBackWhenThereIsTimeAgain) {
  BudgetPolicy policy({.planned_share = 0.8}, 0.05);
  for (int i = 0; i < 100; ++i) {
    policy.learn(cost_of(policy.plan(0.0), 4.0, true));
  }
  StepPlan plan;
  for (int i = 0; i < 60; ++i) {
    plan = policy.plan(0.0);
    policy.learn(cost_of(plan, 1.0, true));
  }
  EXPECT_EQ(plan.register_every, 1);
  EXPECT_TRUE(plan.budget.may_register);
  EXPECT_GE(plan.budget.max_particles, 8000U);
}

TEST(BudgetPolicy, IsNotMovedByASingleSlowStep) {
  BudgetPolicy policy({.planned_share = 0.8}, 0.05);
  for (int i = 0; i < 20; ++i) {
    policy.learn(cost_of(policy.plan(0.0), 1.0, true));
    policy.learn(cost_of({.budget = {.may_register = false}}, 1.0, true));
  }
  policy.learn(cost_of({.budget = {.may_register = false}}, 30.0, true));
  const StepPlan plan = policy.plan(0.0);
  EXPECT_TRUE(plan.budget.may_register);
  EXPECT_GE(plan.budget.max_particles, 8000U);
}

TEST(BudgetPolicy, CountsTheTimeThatAScanHasWaited) {
  BudgetPolicy policy({.planned_share = 0.8, .min_particles = 1000}, 0.05);
  for (int i = 0; i < 20; ++i) {
    policy.learn(cost_of(policy.plan(0.0), 1.0, i % 2 == 0));
  }
  EXPECT_GE(BudgetPolicy(policy).plan(0.0).budget.max_particles, 8000U);
  const StepPlan late = BudgetPolicy(policy).plan(0.03);
  EXPECT_FALSE(late.budget.may_register);
  EXPECT_LT(late.budget.max_particles, 8000U);
  const StepPlan too_late = policy.plan(1.0);
  EXPECT_FALSE(too_late.budget.may_register);
  EXPECT_EQ(too_late.budget.max_particles, 1000U);
}

TEST(BudgetPolicy, IsTheSameForTheSameDurations) {
  BudgetPolicy one({}, 0.02);
  BudgetPolicy two({}, 0.02);
  for (int i = 0; i < 100; ++i) {
    const double slowness = 1.0 + (i * 7) % 5;
    const StepPlan plan = one.plan(0.001 * (i % 3));
    EXPECT_EQ(plan, two.plan(0.001 * (i % 3)));
    one.learn(cost_of(plan, slowness, i % 4 == 0));
    two.learn(cost_of(plan, slowness, i % 4 == 0));
  }
}

TEST(BudgetPolicy, NamesWhatIsOutOfRange) {
  EXPECT_THROW(BudgetPolicy({.planned_share = 0.0}, 0.05), std::invalid_argument);
  EXPECT_THROW(BudgetPolicy({}, 0.0), std::invalid_argument);
  EXPECT_EQ(BudgetPolicy({}, std::nullopt).plan(0.0).budget.max_particles, kNoLimit);
}

}  // namespace
}  // namespace sketchloc

#include "eval/registration_trials.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "eval/registration_suite.hpp"
#include "eval/registration_summary.hpp"
#include "motion/angles.hpp"
#include "tests/support/similarity_registration.hpp"

namespace sketchloc {
namespace {

const RegistrationSet& home() {
  static const RegistrationSet set = [] {
    const auto tasks =
        simulated_tasks({.plans = 1, .warps = 1, .drive_m = 6.0, .sweeps = false, .set = {}}, 3);
    return tasks.front().make();
  }();
  return set;
}

/// Moves every prior by a fixed shift in metres forward and states how far that is off.
class ShiftingPredictor final : public WarpPredictor {
 public:
  explicit ShiftingPredictor(double shift_m) : shift_m_(shift_m) {}

  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper& /*drawing*/,
                                                   std::span<const Sim2> priors) override {
    last_submap_size = submap.size();
    std::vector<std::optional<Registration>> results;
    for (const Sim2& prior : priors) {
      results.push_back(
          testing::similarity_registration(prior * Se2::from_xy_yaw(shift_m_, 0.0, 0.0), 0.1));
      results.back()->inlier_probability = 0.9;
    }
    return results;
  }

  std::size_t last_submap_size = 0;

 private:
  double shift_m_;
};

TEST(RegistrationSet, HasTheTruthOfEveryQuestion) {
  ASSERT_GT(home().steps.size(), 5U);
  for (std::size_t i = 0; i < home().steps.size(); ++i) {
    const RegistrationError none = registration_error(home(), i, home().steps[i].sketch_from_robot);
    EXPECT_NEAR(none.position_m, 0.0, 1e-6);
    EXPECT_NEAR(none.heading_rad, 0.0, 1e-6);
  }
}

TEST(RegistrationSet, MeasuresErrorsInTheWorld) {
  const Sim2& truth = home().steps[3].sketch_from_robot;
  const Se2 true_in_world = home().world_from_robot[3];
  const Se2 off_in_world = true_in_world * Se2::from_xy_yaw(0.3, -0.4, 0.2);
  const Sim2 off = home().sketch_from_world->sketch_from_robot(off_in_world);
  const RegistrationError error = registration_error(home(), 3, off);
  EXPECT_NEAR(error.position_m, 0.5, 1e-6);
  EXPECT_NEAR(error.heading_rad, 0.2, 1e-6);
  EXPECT_NE((off.translation() - truth.translation()).norm() / truth.scale(), 0.5);
}

TEST(RegistrationSet, RemembersEarlierScansWithTheirPlaces) {
  const RegistrationStep& step = home().steps.back();
  ASSERT_GT(step.scans.size(), 2U);
  EXPECT_EQ(step.submap().front().scan, &step.scans.front());
  EXPECT_NEAR(step.robot_from_then.front().translation().norm(), 0.0, 1e-12);
  EXPECT_GT(step.robot_from_then.back().translation().norm(), 0.5);
}

TEST(PriorAround, StaysWithinItsSpread) {
  const Sim2 truth = Sim2::from_xy_yaw_scale(100.0, 50.0, 1.0, 20.0);
  const PriorSpread spread{.shift_m = 2.0, .turn_rad = 0.3, .log_scale_sigma = 0.0};
  Rng rng = make_rng(1);
  double largest_m = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Sim2 off = truth.inverse() * prior_around(truth, spread, rng);
    largest_m = std::max(largest_m, off.translation().norm());
    EXPECT_LE(std::abs(off.yaw_rad()), 0.3 + 1e-12);
  }
  EXPECT_LE(largest_m, 2.0 + 1e-9);
  EXPECT_GT(largest_m, 1.9);
}

TEST(PriorAround, IsExactWhereAsked) {
  const Sim2 truth = Sim2::from_xy_yaw_scale(100.0, 50.0, 1.0, 20.0);
  const PriorSpread spread{.shift_m = 1.5, .turn_rad = 0.4, .log_scale_sigma = 0.0, .exact = true};
  Rng rng = make_rng(2);
  for (int i = 0; i < 50; ++i) {
    const Sim2 off = truth.inverse() * prior_around(truth, spread, rng);
    EXPECT_NEAR(off.translation().norm(), 1.5, 1e-9);
    EXPECT_NEAR(std::abs(off.yaw_rad()), 0.4, 1e-9);
  }
}

TEST(RegistrationTrials, ChainCarriesErrorsOn) {
  ShiftingPredictor shifts(0.1);
  const auto trials = run_chained(home(), {.name = "shifts", .predictor = &shifts});
  ASSERT_EQ(trials.size(), home().steps.size());
  EXPECT_NEAR(trials.front().prior.position_m, 0.0, 1e-6);
  EXPECT_GT(trials.back().prior.position_m, 0.25);
  EXPECT_EQ(trials.front().protocol, "chained");
}

TEST(RegistrationTrials, KeepThePriorWithoutAMethod) {
  const auto trials = run_around_truth(home(), {.name = "none"}, "p", {.shift_m = 1.0}, 5);
  for (const RegistrationTrial& trial : trials) {
    EXPECT_EQ(trial.error.position_m, trial.prior.position_m);
    EXPECT_FALSE(trial.nees_pose);
  }
}

TEST(RegistrationTrials, GiveAllMethodsTheSamePriors) {
  ShiftingPredictor near(0.1);
  ShiftingPredictor far(1.0);
  const PriorSpread spread{.shift_m = 1.0};
  const auto one = run_around_truth(home(), {.name = "a", .predictor = &near}, "p", spread, 5);
  const auto two = run_around_truth(
      home(), {.name = "b", .predictor = &far, .present_scan_only = true}, "p", spread, 5);
  EXPECT_EQ(far.last_submap_size, 1U);
  EXPECT_GT(near.last_submap_size, 1U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].prior.position_m, two[i].prior.position_m);
    EXPECT_NE(one[i].error.position_m, two[i].error.position_m);
  }
}

TEST(RegistrationTrials, JudgeTheCovariance) {
  ShiftingPredictor shifts(0.2);
  const PriorSpread at_truth{.shift_m = 0.0, .turn_rad = 0.0, .log_scale_sigma = 0.0};
  const auto trials =
      run_around_truth(home(), {.name = "a", .predictor = &shifts}, "p", at_truth, 5);
  EXPECT_NEAR(*trials.front().nees_position, 0.04 / 0.01, 1e-6);
  EXPECT_NEAR(*trials.front().nees_pose, 0.04 / 0.01, 1e-6);
}

RegistrationTrial trial_of(const std::string& set, const std::string& method, double error_m) {
  RegistrationTrial trial;
  trial.set = set;
  trial.kind = "k";
  trial.protocol = "p";
  trial.method = method;
  trial.prior = {.position_m = 1.0, .heading_rad = 0.1};
  trial.found = true;
  trial.error = {.position_m = error_m, .heading_rad = 0.1};
  return trial;
}

TEST(RegistrationSummary, CountsAndAverages) {
  const std::vector<RegistrationTrial> trials = {trial_of("s1", "a", 0.2), trial_of("s1", "a", 0.4),
                                                 trial_of("s2", "a", 1.8)};
  const auto rows = summarize_registration(trials);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].sets, 2U);
  EXPECT_NEAR(rows[0].mean_position_m.mean, 0.8, 1e-12);
  EXPECT_NEAR(rows[0].position_m.median, 0.4, 1e-12);
  EXPECT_NEAR(rows[0].share_nearer.mean, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(rows[0].share_right.mean, 2.0 / 3.0, 1e-12);
  ASSERT_TRUE(rows[0].mean_position_m.interval);
  EXPECT_NEAR(rows[0].mean_position_m.interval->low, 0.3, 1e-9);   // both times the first set
  EXPECT_NEAR(rows[0].mean_position_m.interval->high, 1.8, 1e-9);  // both times the second
}

TEST(RegistrationSummary, ComparesOnTheSameQuestions) {
  const std::vector<RegistrationTrial> trials = {trial_of("s1", "a", 0.2), trial_of("s1", "b", 0.5),
                                                 trial_of("s2", "a", 0.3),
                                                 trial_of("s2", "b", 0.5)};
  const auto differences = compare_registration(trials, "a");
  ASSERT_EQ(differences.size(), 1U);
  EXPECT_EQ(differences[0].other, "b");
  EXPECT_NEAR(differences[0].position_m.mean, -0.25, 1e-12);
}

TEST(RegistrationSummary, MeasuresCoverageAndReliability) {
  std::vector<RegistrationTrial> trials;
  for (int i = 0; i < 100; ++i) {
    RegistrationTrial trial = trial_of("s", "a", i < 80 ? 0.1 : 1.0);
    trial.inlier_probability = 0.75;
    trial.nees_position = i < 60 ? 1.0 : 100.0;
    trial.nees_pose = i < 60 ? 1.0 : 100.0;
    trials.push_back(trial);
  }
  const auto row = summarize_registration(trials).front();
  ASSERT_TRUE(row.coverage);
  EXPECT_NEAR(row.coverage->pose_95, 0.6, 1e-12);
  ASSERT_EQ(row.reliability.size(), 1U);
  EXPECT_NEAR(row.reliability[0].mean_stated, 0.75, 1e-9);
  EXPECT_NEAR(row.reliability[0].share_right, 0.8, 1e-12);
}

TEST(RegistrationSuite, RefusesParametersOutOfRange) {
  EXPECT_THROW(simulated_tasks({.warps = 0, .set = {}}, 1), std::invalid_argument);
  EXPECT_THROW(simulated_tasks({.prior_turn_deg = 200.0, .set = {}}, 1), std::invalid_argument);
}

TEST(RegistrationSuite, AsksInTheSameBuildingsForTheSameSeed) {
  const auto make = [] {
    return simulated_tasks({.plans = 1, .warps = 2, .drive_m = 4.0, .sweeps = false, .set = {}}, 7);
  };
  const RegistrationSet one = make().at(1).make();
  const RegistrationSet two = make().at(1).make();
  ASSERT_EQ(one.steps.size(), two.steps.size());
  EXPECT_EQ(one.steps.back().sketch_from_robot.translation(),
            two.steps.back().sketch_from_robot.translation());
}

}  // namespace
}  // namespace sketchloc

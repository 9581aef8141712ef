#include "filter/challengers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sketchloc {
namespace {

constexpr double kPxPerM = 10.0;

Sim2 pose_at(double x_m, double yaw_rad = 0.0) {
  return Sim2::from_xy_yaw_scale(kPxPerM * x_m, 0.0, yaw_rad, kPxPerM);
}

Challenger challenger_at(double x_m, double log_odds, double way_since_look_m = 0.0) {
  return {.sketch_from_robot = pose_at(x_m),
          .belief = {.log_odds = log_odds},
          .way_since_look_m = way_since_look_m};
}

TEST(Challengers, MoveWithTheRobotAndAreDueAfterAWay) {
  Challengers bank({.way_m = 0.5});
  bank.add(challenger_at(1.0, 0.0));
  bank.add(challenger_at(9.0, 0.0, 0.3));
  bank.move(Se2::from_xy_yaw(0.3, 0.0, 0.0), 0.0);
  const std::vector<Challenger> due = bank.take_due();
  ASSERT_EQ(due.size(), 1U);
  EXPECT_NEAR(due[0].sketch_from_robot.x(), 93.0, 1e-9);
  EXPECT_EQ(bank.all().size(), 1U);
}

TEST(Challengers, AreSearchedForMoreTheLessSureTheRobotIs) {
  const ChallengerParams params{
      .lost_priors_per_m = 10.0, .calm_priors_per_m = 2.0, .max_priors = 8};
  Challengers calm(params);
  Challengers lost(params);
  calm.move(Se2::from_xy_yaw(0.5, 0.0, 0.0), 1.0);
  lost.move(Se2::from_xy_yaw(0.5, 0.0, 0.0), 0.0);
  EXPECT_EQ(calm.take_newcomers(), 1U);
  EXPECT_EQ(lost.take_newcomers(), 5U);
  EXPECT_EQ(lost.take_newcomers(), 0U);
  lost.move(Se2::from_xy_yaw(50.0, 0.0, 0.0), 0.0);
  EXPECT_EQ(lost.take_newcomers(), 8U);  // never more in a step
}

TEST(Challengers, KeepTheLikelyOnesApartFromEachOtherAndFromTheTrackedPose) {
  Challengers bank({.count = 2, .keep_log_odds = -5.0, .apart_m = 2.0});
  for (const auto& [x_m, log_odds] :
       {std::pair(10.0, -1.0), std::pair(11.0, 1.0), std::pair(20.0, 0.0), std::pair(30.0, -6.0),
        std::pair(40.0, -2.0), std::pair(0.5, 3.0)}) {
    bank.add(challenger_at(x_m, log_odds));
  }
  bank.tidy(pose_at(0.0));
  ASSERT_EQ(bank.all().size(), 2U);
  EXPECT_NEAR(bank.all()[0].sketch_from_robot.x(), 110.0, 1e-9);
  EXPECT_NEAR(bank.all()[1].sketch_from_robot.x(), 200.0, 1e-9);
}

TEST(Challengers, TakeOverOnlyWhenTheyAreLikelierThanTheTrackedPoseAndThanEachOther) {
  const ChallengerParams params{.take_over_log_odds = 3.0, .take_over_probability = 0.7};
  Challengers bank(params);
  EXPECT_FALSE(bank.first_takes_over(-20.0));
  bank.add(challenger_at(10.0, 2.0));
  EXPECT_TRUE(bank.first_takes_over(-2.0));
  EXPECT_FALSE(bank.first_takes_over(0.0));
  bank.add(challenger_at(20.0, 1.9));  // as likely: places that look alike
  EXPECT_FALSE(bank.first_takes_over(-2.0));
}

TEST(Challengers, ShareTheProbabilityWithWhatNobodyThoughtOf) {
  Challengers bank({});
  bank.add(challenger_at(10.0, std::log(2.0)));
  EXPECT_NEAR(bank.probability(std::log(5.0), std::log(5.0)), 5.0 / 8.0, 1e-12);
  EXPECT_NEAR(bank.probability(std::log(2.0), std::log(5.0)), 2.0 / 8.0, 1e-12);
  EXPECT_NEAR(bank.probability(900.0, 900.0), 1.0, 1e-12);
}

TEST(Challengers, PickPlacesThatAreKnownToNobody) {
  ParticleSet candidates;
  candidates.resize(4);
  for (std::size_t i = 0; i < 4; ++i) {
    candidates.x_px[i] = static_cast<float>(100 * i);
    candidates.y_px[i] = 0.0F;
    candidates.heading_rad[i] = 0.0F;
    candidates.log_scale[i] = static_cast<float>(std::log(kPxPerM));
    candidates.log_weight[i] = 0.0F;
  }
  Challengers bank({});
  bank.add(challenger_at(10.0, 0.0));
  Rng rng = make_rng(1);
  const std::vector<Sim2> picked = bank.pick(candidates, 4, pose_at(0.0), rng);
  ASSERT_EQ(picked.size(), 2U);
  EXPECT_NEAR(picked[0].x() + picked[1].x(), 500.0, 1e-3);
  EXPECT_TRUE(bank.pick(candidates, 0, pose_at(0.0), rng).empty());
}

TEST(ChallengerParams, RefuseWhatIsOutOfRange) {
  EXPECT_THROW(validate(ChallengerParams{.count = -1}), std::invalid_argument);
  EXPECT_THROW(validate(ChallengerParams{.apart_m = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "filter/localizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <stdexcept>

#include "motion/angles.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/two_rooms.hpp"

namespace sketchloc {
namespace {

using testing::Drive;
using testing::drive_through_the_door;
using testing::KnowsTheWay;
using testing::kPxPerM;
using testing::two_rooms;

LocalizerParams small_params() {
  LocalizerParams params;
  params.particles = {.min_particles = 1500, .max_particles = 1500};
  return params;
}

std::vector<StepReport> localize(Localizer& localizer, const Drive& drive) {
  std::vector<StepReport> reports;
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    reports.push_back(localizer.step(drive.scans[i], drive.odom_from_robot[i]));
  }
  return reports;
}

TEST(Localizer, FollowsTheRobotThroughADoor) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  Localizer localizer(sketch, small_params());
  localizer.start_at(drive.sketch_from_robot.front());
  const std::vector<StepReport> reports = localize(localizer, drive);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Eigen::Vector2d error_px = reports[i].estimate.sketch_from_robot.translation() -
                                     drive.sketch_from_robot[i].translation();
    EXPECT_LT(error_px.norm() / kPxPerM, 1.0) << "at step " << i;
  }
}

TEST(Localizer, GivesTheSameParticlesForAnyThreadCount) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  const auto run = [&](int jobs) {
    LocalizerParams params = small_params();
    params.particles = {.min_particles = 500, .max_particles = 1500};
    params.recovery.base_share = 0.02;
    params.recovery.max_share = 0.05;
    params.jobs = jobs;
    Localizer localizer(sketch, params);
    localizer.start_at(drive.sketch_from_robot.front());
    localize(localizer, drive);
    return localizer.particles();
  };
  const ParticleSet one = run(1);
  const ParticleSet four = run(4);
  EXPECT_EQ(one.x_px, four.x_px);
  EXPECT_EQ(one.heading_rad, four.heading_rad);
  EXPECT_EQ(one.diagonal_strain, four.diagonal_strain);
  EXPECT_EQ(one.log_weight, four.log_weight);
}

TEST(Localizer, AllocatesNothingInSteadyState) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  LocalizerParams params = small_params();
  params.recovery.base_share = 0.02;
  params.recovery.max_share = 0.05;
  Localizer localizer(sketch, params);
  localizer.start_at(drive.sketch_from_robot.front());
  for (std::size_t i = 0; i < 10; ++i) {
    localizer.step(drive.scans[i], drive.odom_from_robot[i]);
  }
  const std::size_t before = testing::allocation_count();
  for (std::size_t i = 10; i < drive.scans.size(); ++i) {
    localizer.step(drive.scans[i], drive.odom_from_robot[i]);
  }
  EXPECT_EQ(testing::allocation_count() - before, 0U);
}

TEST(Localizer, TakesNoEvidenceWhileTheRobotStands) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  Localizer localizer(sketch, small_params());
  localizer.start_at(drive.sketch_from_robot.front());
  EXPECT_TRUE(localizer.step(drive.scans[0], Se2()).updated);
  EXPECT_FALSE(localizer.step(drive.scans[0], Se2()).updated);
  EXPECT_FALSE(localizer.step(drive.scans[0], Se2::from_xy_yaw(0.05, 0.0, 0.0)).updated);
  EXPECT_TRUE(localizer.step(drive.scans[0], Se2::from_xy_yaw(0.11, 0.0, 0.0)).updated);
}

TEST(Localizer, GoesOnByOdometryWhereAScanSaysNothing) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  Localizer localizer(sketch, small_params());
  localizer.start_at(drive.sketch_from_robot.front());
  localizer.step(drive.scans[0], drive.odom_from_robot[0]);
  Scan blind = drive.scans[5];
  blind.ranges_m.assign(blind.ranges_m.size(), std::numeric_limits<float>::quiet_NaN());
  const StepReport& report = localizer.step(blind, drive.odom_from_robot[5]);
  EXPECT_FALSE(report.updated);
  const Sim2 error = drive.sketch_from_robot[5].inverse() * report.estimate.sketch_from_robot;
  EXPECT_LT(error.translation().norm(), 0.75) << "metres";
  EXPECT_LT(std::abs(error.yaw_rad()), 0.2);
  EXPECT_FALSE(localizer.step(Scan(), drive.odom_from_robot[6]).updated);
}

TEST(Localizer, FindsTheRobotWithoutAStart) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  LocalizerParams params = small_params();
  params.particles = {.min_particles = 5000, .max_particles = 20000};
  params.beams.exponent = 0.2;
  Localizer localizer(sketch, params);
  ASSERT_EQ(localizer.start_anywhere(drive.scans.front()), GlobalStart::Started);
  const std::vector<StepReport> reports = localize(localizer, drive);
  const Eigen::Vector2d error_px = reports.back().estimate.sketch_from_robot.translation() -
                                   drive.sketch_from_robot.back().translation();
  EXPECT_LT(error_px.norm() / kPxPerM, 1.0);
}

TEST(Localizer, ComesBackAfterBeingCarriedToAnotherRoom) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  LocalizerParams params = small_params();
  params.beams.exponent = 0.2;
  params.recovery.base_share = 0.02;
  params.recovery.max_share = 0.1;
  Localizer localizer(sketch, params);
  localizer.start_at(Sim2::from_xy_yaw_scale(220.0, 120.0, -2.0, kPxPerM));  // it is elsewhere
  const std::vector<StepReport> reports = localize(localizer, drive);
  const Eigen::Vector2d error_px = reports.back().estimate.sketch_from_robot.translation() -
                                   drive.sketch_from_robot.back().translation();
  EXPECT_LT(error_px.norm() / kPxPerM, 1.0);
}

/// Knows it where the prior is within a metre and a half, and says of all others that they are
/// wrong.
class KnowsItNearby final : public WarpPredictor {
 public:
  explicit KnowsItNearby(const Drive& drive) : drive_(drive), knows_(drive) {}

  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper& cropper,
                                                   std::span<const Sim2> priors) override {
    const auto step = static_cast<std::size_t>(submap.front().scan->time_s);
    std::vector<std::optional<Registration>> found = knows_.predict(submap, cropper, priors);
    for (std::size_t i = 0; i < priors.size(); ++i) {
      const Eigen::Vector2d away_px =
          priors[i].translation() - drive_.sketch_from_robot[step].translation();
      if (away_px.norm() > 1.5 * kPxPerM) {
        found[i]->sketch_from_robot = priors[i];
        found[i]->inlier_probability = 0.02;
      }
    }
    return found;
  }

 private:
  const Drive& drive_;
  KnowsTheWay knows_;
};

TEST(Localizer, FindsTheRobotByRegistrationsWhereItStartedWrongTheSameAtAnyNumberOfThreads) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  std::vector<StepReport> first;
  for (const int jobs : {1, 4}) {
    LocalizerParams params = small_params();
    params.beams.exponent = 1e-6;           // the particles alone never come back
    params.localized.start_log_odds = 0.0;  // nobody swears by the start
    params.jobs = jobs;
    KnowsItNearby predictor(drive);
    Localizer localizer(sketch, params, &predictor);
    localizer.start_at(Sim2::from_xy_yaw_scale(220.0, 120.0, -2.0, kPxPerM));
    const std::vector<StepReport> reports = localize(localizer, drive);
    const Eigen::Vector2d error_px = reports.back().estimate.sketch_from_robot.translation() -
                                     drive.sketch_from_robot.back().translation();
    EXPECT_LT(error_px.norm() / kPxPerM, 1.0);
    EXPECT_GT(reports.back().localized_probability, 0.5);
    EXPECT_TRUE(std::ranges::any_of(reports, &StepReport::found_anew));
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(first[i].localized_probability, reports[i].localized_probability);
    }
    first = reports;
  }
}

TEST(Localizer, LetsAPoseThatWasGivenBeContestedOnlyWhereItIsLost) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  const auto finds_anew = [&](double start_log_odds, double lost_log_odds) {
    LocalizerParams params = small_params();
    params.beams.exponent = 1e-6;  // the particles alone never come back
    params.localized.start_log_odds = start_log_odds;
    params.challengers.lost_log_odds = lost_log_odds;
    params.challengers.calm_priors_per_m = params.challengers.lost_priors_per_m;
    KnowsItNearby predictor(drive);
    Localizer localizer(sketch, params, &predictor);
    localizer.start_at(Sim2::from_xy_yaw_scale(220.0, 120.0, -2.0, kPxPerM));
    return std::ranges::any_of(localize(localizer, drive), &StepReport::found_anew);
  };
  constexpr double kGiven = 4.0;
  constexpr double kGuessed = 0.0;
  constexpr double kNever = -20.0;
  EXPECT_TRUE(finds_anew(kGuessed, kNever));
  EXPECT_FALSE(finds_anew(kGiven, kNever));
  EXPECT_TRUE(finds_anew(kGiven, kGuessed));
}

TEST(Localizer, StatesThatItIsLostWhereTheRobotWasCarriedAway) {
  const Sketch sketch = two_rooms();
  Drive drive = drive_through_the_door(sketch);
  for (std::size_t i = 15; i < 20; ++i) {  // what it sees at the end of the drive
    drive.scans[i].ranges_m = drive.scans[i + 20].ranges_m;
  }
  Localizer localizer(sketch, small_params());
  localizer.start_at(drive.sketch_from_robot.front());
  const std::vector<StepReport> reports = localize(localizer, drive);
  EXPECT_GT(reports[14].localized_probability, 0.7);
  EXPECT_GT(reports[15].contradiction, reports[14].contradiction + 0.1);
  EXPECT_LT(reports[15].localized_probability, 0.3);
}

TEST(Localizer, FollowsRegistrationsTheSameAtAnyNumberOfThreads) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  const Sim2 wrong_start = drive.sketch_from_robot.front() * Se2::from_xy_yaw(0.5, -0.5, 0.1);
  std::vector<std::vector<StepReport>> all;
  double alone_m = 0.0;
  double helped_m = 0.0;
  for (const int jobs : {1, 4}) {
    LocalizerParams params = small_params();
    params.beams.exponent = 1e-6;  // the beams say nothing
    params.jobs = jobs;
    params.fusion.measure = true;
    KnowsTheWay predictor(drive);
    Localizer localizer(sketch, params, &predictor);
    localizer.start_at(wrong_start);
    all.push_back(localize(localizer, drive));
    EXPECT_GT(predictor.looks, 10);
  }
  LocalizerParams params = small_params();
  params.beams.exponent = 1e-6;
  Localizer alone(sketch, params);
  alone.start_at(wrong_start);
  const std::vector<StepReport> reports = localize(alone, drive);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Eigen::Vector2d truth = drive.sketch_from_robot[i].translation();
    EXPECT_EQ(all[0][i].estimate.sketch_from_robot.translation(),
              all[1][i].estimate.sketch_from_robot.translation());
    helped_m += (all[0][i].estimate.sketch_from_robot.translation() - truth).norm() / kPxPerM;
    alone_m += (reports[i].estimate.sketch_from_robot.translation() - truth).norm() / kPxPerM;
  }
  EXPECT_LT(helped_m, 0.5 * alone_m);
}

TEST(Localizer, TracksWithinCentimetresOnAMapInTrueProportions) {
  Sketch map = two_rooms();
  map.px_per_m = kPxPerM;
  const Drive drive = drive_through_the_door(map);
  LocalizerParams params = metric_localizer_params();
  params.particles = {.min_particles = 2000, .max_particles = 2000};
  Localizer localizer(map, params);
  localizer.start_at(drive.sketch_from_robot.front());
  const std::vector<StepReport> reports = localize(localizer, drive);
  double sum_squares_m2 = 0.0;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const Eigen::Vector2d error_px = reports[i].estimate.sketch_from_robot.translation() -
                                     drive.sketch_from_robot[i].translation();
    sum_squares_m2 += error_px.squaredNorm() / (kPxPerM * kPxPerM);
  }
  EXPECT_LT(std::sqrt(sum_squares_m2 / static_cast<double>(reports.size())), 0.025);
}

TEST(Localizer, CannotStartAnywhereWhereStrokesEncloseNothing) {
  Sketch sketch;
  sketch.occupied = Grid<std::uint8_t>(50, 50);
  sketch.occupied.at({25, 25}) = 1;
  Localizer localizer(sketch, small_params());
  EXPECT_EQ(localizer.start_anywhere(Scan()), GlobalStart::NoFreeSpace);
}

TEST(Localizer, CannotStartAnywhereWithAScanThatSawNothing) {
  Localizer localizer(two_rooms(), small_params());
  EXPECT_EQ(localizer.start_anywhere(Scan()), GlobalStart::NoReturns);
}

TEST(Localizer, StartsAfreshWhenPlacedAgain) {
  const Sketch sketch = two_rooms();
  const Drive drive = drive_through_the_door(sketch);
  Localizer localizer(sketch, small_params());
  localizer.start_at(drive.sketch_from_robot.front());
  EXPECT_TRUE(localizer.step(drive.scans[0], Se2()).updated);
  localizer.start_at(drive.sketch_from_robot[5]);
  EXPECT_TRUE(localizer.step(drive.scans[5], Se2::from_xy_yaw(7.0, 0.0, 0.0)).updated);
  const Eigen::Vector2d place_px = localizer.step(drive.scans[5], Se2::from_xy_yaw(7.0, 0.0, 0.0))
                                       .estimate.sketch_from_robot.translation();
  EXPECT_LT((place_px - drive.sketch_from_robot[5].translation()).norm() / kPxPerM, 0.5);
}

TEST(LocalizerParams, NameTheFieldThatIsOutOfRange) {
  LocalizerParams params;
  params.beams.exponent = 2.0;
  try {
    validate(params);
    FAIL() << "an exponent of 2 was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "beams.exponent must be in [1e-06, 1], but it is 2");
  }
}

}  // namespace
}  // namespace sketchloc

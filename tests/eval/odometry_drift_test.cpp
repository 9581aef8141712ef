#include "eval/odometry_drift.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <string>

#include "datasets/io/corrected_poses.hpp"
#include "datasets/io/run_io.hpp"
#include "eval/nees.hpp"
#include "motion/angles.hpp"
#include "registration/matched_odometry.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::shared_data;

constexpr double kTolerance = 1e-12;

/// Ten poses, 1 m apart along x, one per second.
MetricTrajectory straight_drive() {
  MetricTrajectory drive;
  for (int i = 0; i < 10; ++i) {
    drive.append(i, Se2::from_xy_yaw(i, 0.0, 0.0));
  }
  return drive;
}

TEST(RelationErrors, AreTheDifferenceOfTheMotionsAtTheNearestPoses) {
  const std::array<Relation, 2> relations = {
      Relation{2.1, 4.9, Se2::from_xy_yaw(3.0, 0.4, 0.0)},    // poses 2 and 5: 0.4 m off
      Relation{0.0, 9.0, Se2::from_xy_yaw(9.0, 0.0, -0.1)}};  // 0.1 rad off
  const RelationErrors result = relation_errors(straight_drive(), relations, 0.2);
  ASSERT_TRUE(result.errors.translation_m);
  EXPECT_EQ(result.unmatched, 0U);
  EXPECT_EQ(result.errors.translation_m->count, 2U);
  EXPECT_NEAR(result.errors.translation_m->mean, 0.2, kTolerance);
  EXPECT_NEAR(result.errors.rotation_rad->mean, 0.05, kTolerance);
  EXPECT_NEAR(result.errors.rotation_rad->max, 0.1, kTolerance);
}

TEST(RelationErrors, LeaveOutRelationsFarFromAnyPoseOrWithinOne) {
  const std::array<Relation, 3> relations = {Relation{2.3, 5.0, Se2()}, Relation{-1.0, 5.0, Se2()},
                                             Relation{3.0, 3.1, Se2()}};
  const RelationErrors result = relation_errors(straight_drive(), relations, 0.2);
  EXPECT_EQ(result.unmatched, 3U);
  EXPECT_FALSE(result.errors.translation_m);
  EXPECT_EQ(relation_errors(MetricTrajectory(), relations, 0.2).unmatched, 3U);
}

TEST(DriftOverWay, ComparesEveryPieceOfTheReferenceOfThatLength) {
  MatchedPoses poses;
  for (int i = 0; i < 10; ++i) {
    poses.world_from_robot.push_back(Se2::from_xy_yaw(i, 0.0, 0.0));
    poses.estimate_from_robot.push_back(Se2::from_xy_yaw(7.0, 1.1 * i, std::numbers::pi / 2));
  }
  const PoseErrors errors = drift_over_way(poses, 2.5);  // pieces of 3 m, 10 % too long
  ASSERT_TRUE(errors.translation_m);
  EXPECT_EQ(errors.translation_m->count, 7U);
  EXPECT_NEAR(errors.translation_m->mean, 0.3, kTolerance);
  EXPECT_NEAR(errors.translation_m->max, 0.3, kTolerance);
  EXPECT_NEAR(errors.rotation_rad->max, 0.0, kTolerance);
  EXPECT_FALSE(drift_over_way(poses, 20.0).translation_m);
  EXPECT_FALSE(drift_over_way({}, 1.0).translation_m);
}

TEST(IncrementNees, IsTheSquaredErrorByItsVariance) {
  const std::array<Se2, 2> truth = {Se2(), Se2::from_xy_yaw(1.0, 0.0, 0.0)};
  std::array<UncertainIncrement, 2> increments;
  increments[1].previous_from_robot = Se2::from_xy_yaw(1.0, 0.5, 0.0);
  increments[1].covariance = 0.09 * Eigen::Matrix3d::Identity();
  const std::vector<double> exact = increment_nees(truth, increments, Eigen::Vector3d::Zero());
  ASSERT_EQ(exact.size(), 1U);
  EXPECT_NEAR(exact[0], 0.25 / 0.09, kTolerance);
  const std::vector<double> widened = increment_nees(truth, increments, {0.4, 0.4, 0.4});
  EXPECT_NEAR(widened[0], 1.0, kTolerance);
}

// From here on: real logs; their figures are in docs/results/odometry.md.

struct RealRun {
  std::string name;
  Run run;
  MetricTrajectory world_from_robot;  ///< corrected
};

struct Odometry {
  MetricTrajectory odom_from_robot;
  std::vector<UncertainIncrement> increments;
  std::array<int, 5> steps_by_status{};
};

std::optional<RealRun> read_real_run(const std::string& name) {
  const auto log = shared_data("logs/" + name + ".log.gz");
  if (!log) {
    return std::nullopt;
  }
  return RealRun{name, read_run(*log), read_corrected_poses(*log)};
}

Odometry raw_odometry(const Run& run) {
  Odometry odometry;
  for (const RunStep& step : run.steps) {
    odometry.odom_from_robot.append(step.scan.time_s, step.odom_from_robot);
  }
  return odometry;
}

Odometry matched_odometry(const Run& run) {
  MatchedOdometry matcher;
  Odometry odometry;
  for (const RunStep& step : run.steps) {
    const MatchedStep matched = matcher.step(step.scan, step.odom_from_robot);
    odometry.odom_from_robot.append(step.scan.time_s, matched.odom_from_robot);
    odometry.increments.push_back({matched.previous_from_robot, matched.covariance});
    ++odometry.steps_by_status[static_cast<std::size_t>(matched.status)];
  }
  return odometry;
}

MatchedPoses pair_up(const RealRun& real, const Odometry& odometry) {
  return {poses_of(real.world_from_robot), poses_of(odometry.odom_from_robot)};
}

double ate_rmse_m(const MatchedPoses& poses) {
  return absolute_errors(*align(poses, Alignment::Se2)).translation_m->rmse;
}

class OdometryDriftEndToEnd : public ::testing::TestWithParam<std::string> {};

TEST_P(OdometryDriftEndToEnd, StaysNearTheCorrectedPosesOfARealLog) {
  const auto real = read_real_run(GetParam());
  if (!real) {
    GTEST_SKIP() << "the development data are not here";
  }
  const Odometry matched = matched_odometry(real->run);
  const MatchedPoses raw_poses = pair_up(*real, raw_odometry(real->run));
  const MatchedPoses poses = pair_up(*real, matched);
  EXPECT_LT(ate_rmse_m(poses), 0.6);
  EXPECT_LT(ate_rmse_m(poses), 0.25 * ate_rmse_m(raw_poses));
  EXPECT_LT(drift_over_way(poses, 10.0).translation_m->median, 0.1);
  EXPECT_LT(deg_from_rad(drift_over_way(poses, 10.0).rotation_rad->median), 1.0);
  EXPECT_LT(matched.steps_by_status[4], 5);
}

TEST_P(OdometryDriftEndToEnd, HasAnHonestCovariance) {
  const auto real = read_real_run(GetParam());
  if (!real) {
    GTEST_SKIP() << "the development data are not here";
  }
  // Corrected poses are off by a few cm themselves; some, by much more: hence the median.
  const Eigen::Vector3d reference_sigma(0.02, 0.02, 0.005);
  const Odometry matched = matched_odometry(real->run);
  const std::vector<double> values =
      increment_nees(poses_of(real->world_from_robot), matched.increments, reference_sigma);
  EXPECT_GT(quantile(values, 0.5), 0.5);
  EXPECT_LT(quantile(values, 0.5), 3.0);  // 2.37 for an honest one
}

INSTANTIATE_TEST_SUITE_P(Logs, OdometryDriftEndToEnd,
                         ::testing::Values("intel", "belgioioso", "fr079", "fr101", "csail"),
                         [](const auto& name) { return name.param; });

struct RelationsOfALog {
  std::string name;
  double max_gap_s;  ///< intel's stamps are exact, fr079's differ by up to 0.1 s
};

class RelationsEndToEnd : public ::testing::TestWithParam<RelationsOfALog> {};

TEST_P(RelationsEndToEnd, AreMetAsWellByMatchedOdometryAsByTheMapperLocally) {
  const auto [name, max_gap_s] = GetParam();
  const auto real = read_real_run(name);
  const auto file = shared_data("relations/" + name + ".relations");
  if (!real || !file) {
    GTEST_SKIP() << "the development data are not here";
  }
  const std::vector<Relation> relations = read_relations(*file);
  const auto errors_of = [&, gap_s = max_gap_s](const MetricTrajectory& trajectory) {
    return relation_errors(trajectory, relations, gap_s).errors;
  };
  const PoseErrors raw = errors_of(raw_odometry(real->run).odom_from_robot);
  const PoseErrors matched = errors_of(matched_odometry(real->run).odom_from_robot);
  const PoseErrors corrected = errors_of(real->world_from_robot);
  EXPECT_LT(matched.translation_m->median, corrected.translation_m->median);
  EXPECT_LT(matched.translation_m->mean, 0.25 * raw.translation_m->mean);
  EXPECT_LT(matched.rotation_rad->mean, 0.1 * raw.rotation_rad->mean);
}

INSTANTIATE_TEST_SUITE_P(Logs, RelationsEndToEnd,
                         ::testing::Values(RelationsOfALog{"intel", 0.001},
                                           RelationsOfALog{"fr079", 0.12}),
                         [](const auto& log) { return log.param.name; });

}  // namespace
}  // namespace sketchloc

#include "eval/trajectory_errors.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr double kTolerance = 1e-12;

std::vector<Se2> facing_east(const std::vector<Eigen::Vector2d>& positions) {
  std::vector<Se2> poses;
  for (const Eigen::Vector2d& position : positions) {
    poses.push_back(Se2::from_xy_yaw(position.x(), position.y(), 0.0));
  }
  return poses;
}

std::vector<Se2> moved(const Se2& motion, std::vector<Se2> poses) {
  for (Se2& pose : poses) {
    pose = motion * pose;
  }
  return poses;
}

/// The estimate is 1.2 times as wide and 0.8 times as high as the reference, in another frame.
MatchedPoses stretched_cross() {
  return {.world_from_robot = facing_east({{1, 0}, {-1, 0}, {0, 1}, {0, -1}}),
          .estimate_from_robot = moved(Se2::from_xy_yaw(5.0, -3.0, 2.0),
                                       facing_east({{1.2, 0}, {-1.2, 0}, {0, 0.8}, {0, -0.8}}))};
}

PoseErrors errors_after(const MatchedPoses& poses, Alignment alignment) {
  return absolute_errors(*align(poses, alignment));
}

TEST(MatchPoses, LeavesOutPosesWithoutAPartnerInTime) {
  MetricTrajectory reference;
  MetricTrajectory estimate;
  for (const double time_s : {0.0, 1.0, 2.0}) {
    reference.append(time_s, Se2::from_xy_yaw(time_s, 0.0, 0.0));
  }
  for (const double time_s : {0.004, 1.02, 2.009}) {
    estimate.append(time_s, Se2::from_xy_yaw(10.0 * time_s, 0.0, 0.0));
  }
  const MatchedPoses matched = match_poses(reference, estimate);
  ASSERT_EQ(matched.world_from_robot.size(), 2U);
  EXPECT_DOUBLE_EQ(matched.world_from_robot[1].x_m(), 2.0);
  EXPECT_DOUBLE_EQ(matched.estimate_from_robot[1].x_m(), 20.09);
}

TEST(AbsoluteErrors, UnalignedAreDistancesAndAngles) {
  const double quarter_rad = std::numbers::pi / 2.0;
  const MatchedPoses poses{
      .world_from_robot = {Se2(), Se2::from_xy_yaw(1.0, 0.0, std::numbers::pi - 0.1)},
      .estimate_from_robot = {Se2::from_xy_yaw(3.0, 4.0, -quarter_rad),
                              Se2::from_xy_yaw(1.0, 1.0, -std::numbers::pi + 0.1)}};
  const PoseErrors errors = errors_after(poses, Alignment::None);
  EXPECT_NEAR(errors.translation_m->max, 5.0, kTolerance);
  EXPECT_NEAR(errors.translation_m->mean, 3.0, kTolerance);
  EXPECT_NEAR(errors.rotation_rad->max, quarter_rad, kTolerance);
  EXPECT_NEAR(errors.rotation_rad->mean, 0.5 * (quarter_rad + 0.2), kTolerance);
}

// The estimate starts turned by 90 degrees and half a metre off in its second pose.
TEST(AbsoluteErrors, FirstPoseAlignmentMakesTheFirstErrorZero) {
  const MatchedPoses poses{
      .world_from_robot = facing_east({{1, 1}, {2, 1}}),
      .estimate_from_robot = moved(Se2::from_xy_yaw(-4.0, 7.0, std::numbers::pi / 2.0),
                                   facing_east({{0, 0}, {1, 0.5}}))};
  const PoseErrors errors = errors_after(poses, Alignment::FirstPose);
  EXPECT_NEAR(errors.translation_m->max, 0.5, kTolerance);
  EXPECT_NEAR(errors.translation_m->mean, 0.25, kTolerance);
  EXPECT_NEAR(errors.rotation_rad->max, 0.0, kTolerance);
}

// By symmetry the best rigid motion undoes the frame change: every point is 0.2 m off.
TEST(AbsoluteErrors, Se2AlignmentLeavesTheStretch) {
  const PoseErrors errors = errors_after(stretched_cross(), Alignment::Se2);
  EXPECT_NEAR(errors.translation_m->rmse, 0.2, kTolerance);
  EXPECT_NEAR(errors.translation_m->max, 0.2, kTolerance);
  EXPECT_NEAR(errors.rotation_rad->max, 0.0, kTolerance);
}

// The best scale is (2 * 1.2 + 2 * 0.8) / (2 * 1.44 + 2 * 0.64) = 4 / 4.16.
TEST(AbsoluteErrors, Sim2AlignmentFindsTheBestScale) {
  const double scale = 4.0 / 4.16;
  const PoseErrors errors = errors_after(stretched_cross(), Alignment::Sim2);
  EXPECT_NEAR(errors.translation_m->max, 1.0 - 0.8 * scale, kTolerance);
  EXPECT_NEAR(errors.translation_m->mean, 0.5 * (1.2 * scale - 1.0 + 1.0 - 0.8 * scale),
              kTolerance);
  EXPECT_NEAR(errors.rotation_rad->max, 0.0, kTolerance);
}

TEST(AbsoluteErrors, HaveNoAlignmentForNothingOrForOnePlaceWithScale) {
  EXPECT_FALSE(align({}, Alignment::Se2).has_value());
  const MatchedPoses standing{.world_from_robot = facing_east({{1, 1}, {2, 1}}),
                              .estimate_from_robot = facing_east({{0, 0}, {0, 0}})};
  EXPECT_FALSE(align(standing, Alignment::Sim2).has_value());
  EXPECT_NEAR(errors_after(standing, Alignment::Se2).translation_m->max, 0.5, kTolerance);
}

// The estimate drives 1.25 m where the reference drives 1 m, and turns left by 0.1 rad too much
// in its second step.
TEST(RelativeErrors, AreWhatTheEstimateAddsToTheMotion) {
  const Se2 reference_step = Se2::from_xy_yaw(1.0, 0.0, 0.0);
  const Se2 too_far = Se2::from_xy_yaw(1.25, 0.0, 0.0);
  const Se2 too_far_and_turned = Se2::from_xy_yaw(1.25, 0.0, 0.1);
  const MatchedPoses poses{
      .world_from_robot = {Se2(), reference_step, reference_step * reference_step},
      .estimate_from_robot = {Se2(), too_far, too_far * too_far_and_turned}};
  const PoseErrors errors = relative_errors(poses, {.delta = FrameDelta{1}});
  EXPECT_EQ(errors.translation_m->count, 2U);
  EXPECT_NEAR(errors.translation_m->mean, 0.25, kTolerance);
  EXPECT_NEAR(errors.translation_m->max, 0.25, kTolerance);
  EXPECT_NEAR(errors.rotation_rad->max, 0.1, kTolerance);
  EXPECT_NEAR(errors.rotation_rad->mean, 0.05, kTolerance);
}

TEST(RelativeErrors, DoNotDependOnTheFrameOfTheEstimate) {
  const MatchedPoses poses = stretched_cross();
  const MatchedPoses elsewhere{
      .world_from_robot = poses.world_from_robot,
      .estimate_from_robot = moved(Se2::from_xy_yaw(9.0, 9.0, 1.0), poses.estimate_from_robot)};
  EXPECT_NEAR(relative_errors(poses, {}).translation_m->rmse,
              relative_errors(elsewhere, {}).translation_m->rmse, kTolerance);
}

TEST(RelativePairs, ByFramesFollowEachOtherOrOverlap) {
  const auto poses = facing_east({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}});
  EXPECT_THAT(relative_pairs(poses, {.delta = FrameDelta{2}, .all_pairs = false}),
              ElementsAre(Pair(0, 2), Pair(2, 4)));
  EXPECT_THAT(relative_pairs(poses, {.delta = FrameDelta{2}}),
              ElementsAre(Pair(0, 2), Pair(1, 3), Pair(2, 4)));
  EXPECT_THAT(relative_pairs(poses, {.delta = FrameDelta{5}}), IsEmpty());
}

// Way at the poses: 0, 0.5, 1, 1.75, 2, 2 m.
TEST(RelativePairs, ByPathTakeTheNearestPoseWithinTheTolerance) {
  const auto poses = facing_east({{0, 0}, {0.5, 0}, {1, 0}, {1, 0.75}, {1, 1}, {1, 1}});
  EXPECT_THAT(relative_pairs(poses, {.delta = PathDelta{.path_m = 1.0}}),
              ElementsAre(Pair(0, 2), Pair(2, 4)));
  EXPECT_THAT(
      relative_pairs(poses, {.delta = PathDelta{.path_m = 1.0, .relative_tolerance = 0.25}}),
      ElementsAre(Pair(0, 2), Pair(1, 3), Pair(2, 4)));
}

// As in evo: the first mark is where the way reaches the delta, not the first pose.
TEST(RelativePairs, ByPathThatFollowEachOtherBeginAtTheFirstMark) {
  const auto poses = facing_east({{0, 0}, {0.5, 0}, {1, 0}, {1, 0.75}, {1, 1}, {1, 1}});
  EXPECT_THAT(relative_pairs(poses, {.delta = PathDelta{.path_m = 1.0}, .all_pairs = false}),
              ElementsAre(Pair(2, 4)));
}

TEST(RelativePairs, StandingStillTakeTheFirstPoseOfThePlace) {
  const auto poses = facing_east({{0, 0}, {0.95, 0}, {0.95, 0}, {0.95, 0}});
  EXPECT_THAT(relative_pairs(poses, {.delta = PathDelta{.path_m = 1.0}}), ElementsAre(Pair(0, 1)));
}

TEST(RelativePairs, SayWhichParameterIsOutOfRange) {
  EXPECT_THROW(relative_pairs({}, {.delta = FrameDelta{0}}), std::invalid_argument);
  EXPECT_THROW(relative_pairs({}, {.delta = PathDelta{.path_m = 0.0}}), std::invalid_argument);
}

TEST(RelativeErrors, OfOnePoseAreNone) {
  const MatchedPoses one{.world_from_robot = {Se2()}, .estimate_from_robot = {Se2()}};
  EXPECT_FALSE(relative_errors(one, {}).translation_m.has_value());
}

}  // namespace
}  // namespace sketchloc

#include "eval/odometry_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "motion/angles.hpp"
#include "registration/matched_odometry.hpp"

namespace sketchloc {
namespace {

constexpr double kTolerance = 1e-9;

/// 120 m straight on, 1 m per second; the wheels measure 10 % too much, and the robot sees nothing.
struct BlindDrive {
  sketchloc::Run run;
  MetricTrajectory corrected;
};

BlindDrive blind_drive() {
  BlindDrive drive;
  for (int i = 0; i <= 120; ++i) {
    RunStep step;
    step.scan.time_s = i;
    step.odom_from_robot = Se2::from_xy_yaw(1.1 * i, 0.0, 0.0);
    drive.run.steps.push_back(step);
    drive.corrected.append(i, Se2::from_xy_yaw(i, 0.0, 0.0));
  }
  return drive;
}

const PoseErrors& errors_of(const OdometryComparison& found, const std::string& odometry,
                            const std::string& reference) {
  const auto row = std::ranges::find_if(found.rows, [&](const OdometryErrors& one) {
    return one.odometry == odometry && one.reference == reference;
  });
  EXPECT_NE(row, found.rows.end()) << odometry << " against " << reference;
  static const PoseErrors kNone;
  return row == found.rows.end() ? kNone : row->errors;
}

TEST(OdometryComparison, KeepsShortAndLongRelationsApart) {
  const BlindDrive drive = blind_drive();
  const std::array<Relation, 4> relations = {
      Relation{0.0, 10.0, Se2::from_xy_yaw(10.0, 0.0, 0.1)},  // 1 m and 0.1 rad off
      Relation{0.0, 60.0, Se2::from_xy_yaw(60.0, 0.0, 0.0)},  // 6 m off
      Relation{0.0, 61.0, Se2::from_xy_yaw(61.0, 0.0, 0.0)},  // 6.1 m off
      Relation{0.0, 500.0, Se2()}};                           // after the log
  const OdometryComparison found =
      compare_odometry(drive.run, drive.corrected, relations, {.max_gap_s = 0.1});
  const PoseErrors& up_to = errors_of(found, "wheels", "relations up to 60 s");
  ASSERT_TRUE(up_to.translation_m);
  EXPECT_EQ(up_to.translation_m->count, 2U);
  // the first error is seen from the relation's second pose: its length is the same
  EXPECT_NEAR(up_to.translation_m->mean, 3.5, kTolerance);
  EXPECT_NEAR(deg_from_rad(up_to.rotation_rad->max), deg_from_rad(0.1), kTolerance);
  const PoseErrors& over = errors_of(found, "wheels", "relations over 60 s");
  ASSERT_TRUE(over.translation_m);
  EXPECT_NEAR(over.translation_m->max, 6.1, kTolerance);
  EXPECT_NEAR(errors_of(found, "corrected", "relations over 60 s").translation_m->max, 0.0,
              kTolerance);
  EXPECT_EQ(found.unmatched_relations, 1U);
}

TEST(OdometryComparison, MeasuresDriftAgainstTheCorrectedPoses) {
  const BlindDrive drive = blind_drive();
  const OdometryComparison found = compare_odometry(drive.run, drive.corrected, {});
  EXPECT_NEAR(errors_of(found, "wheels", "corrected poses, over 10 m").translation_m->max, 1.0,
              kTolerance);
  EXPECT_NEAR(errors_of(found, "matched", "corrected poses, over 1 m").translation_m->median, 0.1,
              kTolerance);  // without anything to see, the wheels decide
  // aligned at the middle, 10 % too long: 6 m off at both ends
  EXPECT_NEAR(errors_of(found, "wheels", "corrected poses, whole log").translation_m->max, 6.0,
              kTolerance);
  EXPECT_EQ(found.steps_by_status[static_cast<std::size_t>(MatchedStep::Status::First)] +
                found.steps_by_status[static_cast<std::size_t>(MatchedStep::Status::TooFewPoints)],
            drive.run.steps.size());
  ASSERT_TRUE(found.honesty);
  EXPECT_GT(found.honesty->median_nees, 0.0);
}

}  // namespace
}  // namespace sketchloc

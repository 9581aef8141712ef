#include "filter/online/tracker.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

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
  params.particles = {.min_particles = 1000, .max_particles = 1500};
  return params;
}

/// A robot that drives, and a clock that goes only when it is told.
class TrackerTest : public ::testing::Test {
 protected:
  /// All that a tracker needs, of its own.
  struct Robot {
    Robot(TrackerTest& test, std::optional<double> deadline_s, WarpPredictor* predictor = nullptr)
        : localizer(test.sketch_, small_params(), predictor),
          tracker({}, {.localizer = localizer,
                       .odometry = odometry,
                       .start =
                           [&test](Localizer& started, const Scan&) {
                             started.start_at(test.drive_.sketch_from_robot.front());
                             return true;
                           },
                       .clock = [&test] { return test.tick(); },
                       .deadline_s = deadline_s}) {}

    Localizer localizer;
    OdometryFeed odometry{OdometrySource::Matched, {}};
    Tracker tracker;
  };

  double tick() {
    now_s_ += tick_s_;
    return now_s_;
  }
  Message message(std::size_t i) const {
    return {.time_s = drive_.scans[i].time_s,
            .odom_from_robot = drive_.odom_from_robot[i],
            .scan = drive_.scans[i]};
  }
  TrackedScan track(Tracker& tracker, const Message& what) {
    tracker.take(what, now_s_);
    const std::vector<TrackedScan> done = tracker.work();
    EXPECT_EQ(done.size(), 1U);
    return done.empty() ? TrackedScan() : done.back();
  }
  double error_m(const TrackedScan& scan, std::size_t i) const {
    return (scan.report.estimate.sketch_from_robot.translation() -
            drive_.sketch_from_robot[i].translation())
               .norm() /
           kPxPerM;
  }
  static std::string bytes_of(const Tracker& tracker) {
    StateWriter state;
    tracker.save(state);
    return state.bytes();
  }

  Sketch sketch_ = two_rooms();
  Drive drive_ = drive_through_the_door(sketch_);
  double now_s_ = 1000.0;
  double tick_s_ = 0.0;
};

TEST_F(TrackerTest, DoesWhatTheLocalizerDoesWithoutALoop) {
  Robot robot(*this, std::nullopt);
  Localizer alone(sketch_, small_params());
  alone.start_at(drive_.sketch_from_robot.front());
  OdometryFeed odometry(OdometrySource::Matched, {});
  for (std::size_t i = 0; i < drive_.scans.size(); ++i) {
    const TrackedScan tracked = track(robot.tracker, message(i));
    const RunStep step{drive_.scans[i], drive_.odom_from_robot[i]};
    const StepReport& report = alone.step(step.scan, odometry.odom_from_robot(step));
    EXPECT_EQ(tracked.report.estimate.sketch_from_robot.translation(),
              report.estimate.sketch_from_robot.translation());
    EXPECT_EQ(tracked.report.estimate.covariance, report.estimate.covariance);
  }
}

TEST_F(TrackerTest, GoesOnWithTheSameBytesFromAState) {
  KnowsTheWay predictor(drive_);
  Robot whole(*this, std::nullopt, &predictor);
  for (std::size_t i = 0; i < 15; ++i) {
    track(whole.tracker, message(i));
  }
  Robot resumed(*this, std::nullopt, &predictor);
  const std::string kept = bytes_of(whole.tracker);
  StateReader state(kept);
  resumed.tracker.load(state);
  EXPECT_TRUE(state.at_end());
  for (std::size_t i = 15; i < drive_.scans.size(); ++i) {
    track(whole.tracker, message(i));
    track(resumed.tracker, message(i));
  }
  EXPECT_EQ(bytes_of(resumed.tracker), bytes_of(whole.tracker));
}

TEST_F(TrackerTest, FindsTheRobotAgainAfterAGap) {
  Robot first(*this, std::nullopt);
  for (std::size_t i = 0; i < 15; ++i) {
    track(first.tracker, message(i));
  }
  const std::string kept = bytes_of(first.tracker);
  Robot resumed(*this, std::nullopt);
  StateReader state(kept);
  resumed.tracker.load(state);
  for (std::size_t i = 22; i < drive_.scans.size(); ++i) {
    const TrackedScan scan = track(resumed.tracker, message(i));
    EXPECT_LT(error_m(scan, i), 1.0) << "at step " << i;
  }
  EXPECT_EQ(resumed.tracker.intake_counts().gaps, 1U);
}

TEST_F(TrackerTest, StaysLocalizedWhereTheOdometryJumps) {
  Robot robot(*this, std::nullopt);
  for (std::size_t i = 0; i < drive_.scans.size(); ++i) {
    Message what = message(i);
    if (i >= 20) {
      what.odom_from_robot = Se2::from_xy_yaw(30.0, -20.0, 2.0) * *what.odom_from_robot;
    }
    const TrackedScan scan = track(robot.tracker, what);
    EXPECT_EQ(scan.unmeasured_s.has_value(), i == 20);
    EXPECT_LT(error_m(scan, i), 1.0) << "at step " << i;
  }
  EXPECT_EQ(robot.tracker.intake_counts().odometry_jumps, 1U);
}

TEST_F(TrackerTest, GoesOnThroughBlindScansAndOtherBeamCounts) {
  Robot robot(*this, std::nullopt);
  for (std::size_t i = 0; i < drive_.scans.size(); ++i) {
    Message what = message(i);
    if (i % 7 == 3) {
      what.scan->ranges_m.assign(181, std::numeric_limits<float>::quiet_NaN());
    } else if (i % 5 == 2) {
      what.scan->ranges_m.resize(90);
    }
    EXPECT_LT(error_m(track(robot.tracker, what), i), 1.0) << "at step " << i;
  }
  EXPECT_GT(robot.tracker.intake_counts().blind_scans, 0U);
  EXPECT_GT(robot.tracker.intake_counts().beam_count_changes, 0U);
}

TEST_F(TrackerTest, LeavesOutOlderScansWhereTheyQueueUp) {
  Robot robot(*this, 0.05);
  for (std::size_t i = 0; i < 5; ++i) {
    robot.tracker.take(message(i), 1000.0);
  }
  now_s_ = 1001.0;
  const std::vector<TrackedScan> done = robot.tracker.work();
  ASSERT_EQ(done.size(), 5U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(done[i].refusal, Refusal::Late);
    EXPECT_EQ(done[i].time_s, drive_.scans[i].time_s);
  }
  EXPECT_EQ(done[4].status, TrackedScan::Status::Tracked);
  EXPECT_TRUE(done[4].missed_deadline);
  EXPECT_FALSE(robot.tracker.has_work());
}

TEST_F(TrackerTest, LeavesOutNothingWithoutADeadline) {
  Robot robot(*this, std::nullopt);
  for (std::size_t i = 0; i < 5; ++i) {
    robot.tracker.take(message(i), 1000.0);
  }
  now_s_ = 2000.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::vector<TrackedScan> done = robot.tracker.work();
    ASSERT_EQ(done.size(), 1U);
    EXPECT_EQ(done[0].status, TrackedScan::Status::Tracked);
  }
}

TEST_F(TrackerTest, UsesFewerParticlesWhereTimeIsShortAndAllAgainLater) {
  Robot robot(*this, 0.05);
  tick_s_ = 0.03;  // each look at the clock
  std::size_t i = 0;
  TrackedScan scan;
  for (; i < 12; ++i) {
    scan = track(robot.tracker, message(i));
  }
  EXPECT_EQ(scan.report.particles, BudgetParams{}.min_particles);
  EXPECT_TRUE(scan.missed_deadline);
  tick_s_ = 1e-4;
  for (; i < drive_.scans.size(); ++i) {
    scan = track(robot.tracker, message(i));
    EXPECT_LT(error_m(scan, i), 1.0);
  }
  EXPECT_GT(scan.plan.budget.max_particles, 1500U);
  EXPECT_FALSE(scan.missed_deadline);
}

TEST_F(TrackerTest, WaitsForAScanThatTellsWhereToStart) {
  Localizer localizer(sketch_, small_params());
  OdometryFeed odometry(OdometrySource::Raw, {});
  int asked = 0;
  Tracker tracker({}, {.localizer = localizer,
                       .odometry = odometry,
                       .start =
                           [&](Localizer& started, const Scan&) {
                             started.start_at(drive_.sketch_from_robot.front());
                             return ++asked == 3;
                           },
                       .clock = [this] { return tick(); }});
  EXPECT_EQ(track(tracker, message(0)).status, TrackedScan::Status::NotStarted);
  EXPECT_EQ(track(tracker, message(1)).status, TrackedScan::Status::NotStarted);
  EXPECT_FALSE(tracker.started());
  EXPECT_EQ(track(tracker, message(2)).status, TrackedScan::Status::Tracked);
  EXPECT_EQ(track(tracker, message(3)).report.step, 1U);
  EXPECT_EQ(asked, 3);
}

TEST_F(TrackerTest, SaysWhatCameOutOfOrder) {
  Robot robot(*this, std::nullopt);
  track(robot.tracker, message(3));
  const TrackedScan old = track(robot.tracker, message(2));
  EXPECT_EQ(old.status, TrackedScan::Status::Refused);
  EXPECT_EQ(old.refusal, Refusal::OutOfOrder);
  EXPECT_EQ(old.time_s, 2.0);
}

}  // namespace
}  // namespace sketchloc

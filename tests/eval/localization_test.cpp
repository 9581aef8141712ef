#include "eval/localization.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "datasets/sim/data_set.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

/// A short drive through a simulated home and somebody's drawing of it.
const DataSet& data_set() {
  static const DataSet made = [] {
    DataSetParams params;
    params.building = BuildingKind::Home;
    params.drive.length_m = 12.0;
    return generate_data_set(params, 3);
  }();
  return made;
}

LocalizationTask from_the_start() {
  return {.start_sketch_from_robot = data_set().reference.poses.front().sketch_from_robot};
}

LocalizationParams few_particles(int jobs) {
  LocalizationParams params;
  params.localizer.particles.min_particles = 300;
  params.localizer.particles.max_particles = 1000;
  params.localizer.table.memory_mb = 20.0;
  params.localizer.jobs = jobs;
  return params;
}

Localization localized(const LocalizationTask& task, int jobs = 1) {
  return localize(data_set().drawing.sketch, data_set().run, task, few_particles(jobs));
}

TEST(LocalizationEndToEnd, ReportsEveryStepAndStaysNearTheTruth) {
  const Localization found = localized(from_the_start());
  ASSERT_EQ(found.status, Localization::Status::Done);
  ASSERT_EQ(found.steps.size(), data_set().run.steps.size());
  EXPECT_FALSE(found.snapshots.empty());
  const auto errors = step_errors(found.steps, data_set().reference);
  EXPECT_LT(summarize_sketch_errors(errors).translation_m->median, 1.5);
}

TEST(LocalizationEndToEnd, IsTheSameForAnyNumberOfThreads) {
  const Localization one = localized(from_the_start(), 1);
  const Localization two = localized(from_the_start(), 2);
  ASSERT_EQ(one.steps.size(), two.steps.size());
  for (std::size_t i = 0; i < one.steps.size(); ++i) {
    EXPECT_EQ(one.steps[i].estimate.sketch_from_robot.translation(),
              two.steps[i].estimate.sketch_from_robot.translation());
  }
}

TEST(LocalizationEndToEnd, StartsAnywhereWithoutAStart) {
  const Localization found = localized({});
  EXPECT_EQ(found.status, Localization::Status::Done);
  EXPECT_EQ(found.steps.size(), data_set().run.steps.size());
}

TEST(Localization, TellsProgressAndStopsWhenThatThrows) {
  std::size_t heard = 0;
  const auto stop_at_three = [&](std::size_t done) {
    heard = done;
    if (done == 3) {
      throw std::runtime_error("stop");
    }
  };
  LocalizationTask task = from_the_start();
  task.method = Method::Odometry;
  task.odometry = OdometrySource::Raw;
  EXPECT_THROW(localize(data_set().drawing.sketch, data_set().run, task, {}, stop_at_three),
               std::runtime_error);
  EXPECT_EQ(heard, 3U);
}

TEST(Localization, OfAnEmptyRunSaysSo) {
  EXPECT_EQ(localize(data_set().drawing.sketch, {}, from_the_start()).status,
            Localization::Status::EmptyRun);
}

TEST(DeadReckoning, NeedsAStart) {
  EXPECT_EQ(localized({.method = Method::Odometry}).status, Localization::Status::NoStart);
}

// 2 m forward from a start that looks up the drawing (+y) at 10 px/m: 20 px up.
TEST(DeadReckoning, MovesTheStartByTheOdometry) {
  sketchloc::Run run;  // not the fixture's
  run.steps.resize(2);
  run.steps[0].odom_from_robot = Se2::from_xy_yaw(5.0, 5.0, 1.0);
  run.steps[1].odom_from_robot = run.steps[0].odom_from_robot * Se2::from_xy_yaw(2.0, 0.0, 0.0);
  run.steps[1].scan.time_s = 1.0;
  const double up_rad = 1.5707963267948966;
  const LocalizationTask task{
      .method = Method::Odometry,
      .odometry = OdometrySource::Raw,
      .start_sketch_from_robot = Sim2::from_xy_yaw_scale(100.0, 50.0, up_rad, 10.0)};
  const Localization found = localize(Sketch{}, run, task);
  ASSERT_EQ(found.steps.size(), 2U);
  EXPECT_THAT(found.steps[1].estimate.sketch_from_robot,
              IsNear(Sim2::from_xy_yaw_scale(100.0, 70.0, up_rad, 10.0), 1e-9));
}

// A square room of 80 px inside, which a scan from its middle sees as 4 m wide: 20 px/m.
TEST(GuessPxPerM, ComparesWhatTheScanSeesWithWhatIsDrawn) {
  Sketch sketch;
  sketch.occupied = Grid<std::uint8_t>(100, 100);
  for (int i = 9; i <= 90; ++i) {
    for (const Cell& cell : {Cell{i, 9}, Cell{i, 90}, Cell{9, i}, Cell{90, i}}) {
      sketch.occupied.at(cell) = 1;
    }
  }
  Scan scan;
  scan.angle_step_rad = 1.5707963267948966;
  scan.max_range_m = 10.0;
  scan.ranges_m = {2.0F, 2.0F, 2.0F, 2.0F};
  const auto px_per_m = guess_px_per_m(sketch, {50.0, 50.0}, 0.0, scan);
  ASSERT_TRUE(px_per_m.has_value());
  EXPECT_NEAR(*px_per_m, 20.0, 1e-3);
  EXPECT_FALSE(guess_px_per_m(Sketch{}, {50.0, 50.0}, 0.0, scan).has_value());
}

}  // namespace
}  // namespace sketchloc

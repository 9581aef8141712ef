#include "tests/support/shared_data.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;
using testing::shared_data;

TEST(RealLogs, GiveTheRawOdometryOfIntel) {
  const auto log = shared_data("logs/intel.log.gz");
  if (!log) {
    GTEST_SKIP() << "the development data are not here";
  }
  const sketchloc::Run run = read_run(*log);
  ASSERT_EQ(run.steps.size(), 910U);
  const Scan& scan = run.steps[0].scan;
  EXPECT_EQ(scan.ranges_m.size(), 180U);
  EXPECT_DOUBLE_EQ(scan.first_angle_rad, -std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(scan.angle_step_rad, std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(scan.time_s, 976052890.244111);
  EXPECT_THAT(run.steps[0].odom_from_robot,
              IsNear(Se2::from_xy_yaw(0.698, -0.015, -0.463373), 1e-9));
}

TEST(RealDrawings, AreReadAsStrokes) {
  for (const char* name : {"intel_sketch_3_rot180.png", "belgioioso_sketch.png"}) {
    const auto picture = shared_data(std::filesystem::path("sketches") / name);
    if (!picture) {
      GTEST_SKIP() << "the development data are not here";
    }
    const Sketch sketch = read_sketch(*picture);
    EXPECT_EQ(sketch.kind, Sketch::Kind::Strokes) << name;
    double occupied = 0;
    for (const std::uint8_t cell : sketch.occupied.cells()) {
      occupied += cell;
    }
    const double share = occupied / static_cast<double>(sketch.occupied.cells().size());
    EXPECT_GT(share, 0.01) << name;
    EXPECT_LT(share, 0.08) << name;
  }
}

TEST(RealReferences, AreTurnedIntoTheSketchFrame) {
  const auto csv = shared_data("references/intel_sketch_3_rot180/reference.csv");
  if (!csv) {
    GTEST_SKIP() << "the development data are not here";
  }
  const Reference reference = read_reference(*csv, 679);
  ASSERT_EQ(reference.poses.size(), 910U);
  const ReferencePose& first = reference.poses[0];
  EXPECT_THAT(first.sketch_from_robot,
              IsNear(Sim2::from_xy_yaw_scale(1111.93, 679 - 0.5 - 560.76, 2.66318, 14.590), 1e-9));
  EXPECT_DOUBLE_EQ(first.uncertainty_m, 0.738);
  EXPECT_TRUE(first.scored);
}

}  // namespace
}  // namespace sketchloc

#include "datasets/sim/scan_agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/sim/data_set.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

constexpr double kPi = std::numbers::pi;

/// A drawn wall at x = 100 px, and a robot at (50.5, 50.5) that looks at it with 10 px/m: the wall
/// is 4.95 m away in the drawing.
struct Scene {
  Sketch sketch{.occupied = Grid<std::uint8_t>(200, 100), .px_per_m = std::nullopt};
  sketchloc::Run run;
  Reference reference;
};

Scene scene(std::vector<float> ranges_m, double first_angle_rad, double angle_step_rad) {
  Scene made;
  for (int row = 0; row < 100; ++row) {
    made.sketch.occupied.at({100, row}) = 1;
  }
  made.run.steps.push_back({.scan = {.first_angle_rad = first_angle_rad,
                                     .angle_step_rad = angle_step_rad,
                                     .max_range_m = 30.0,
                                     .robot_from_laser = {},
                                     .ranges_m = std::move(ranges_m)},
                            .odom_from_robot = {}});
  made.reference.poses.push_back(
      {.sketch_from_robot = Sim2::from_xy_yaw_scale(50.5, 50.5, 0.0, 10.0)});
  return made;
}

ScanAgreement agreement(const Scene& scene) {
  return measure_agreement(scene.sketch, scene.run, scene.reference);
}

TEST(ScanAgreement, IsTheLogOfMeasuredOverDrawnRange) {
  const ScanAgreement found = agreement(scene({9.9F}, 0.0, 0.1));
  EXPECT_EQ(found.returns, 1U);
  EXPECT_NEAR(found.median_log_ratio, std::log(2.0), 1e-5);
  EXPECT_EQ(found.share_within_0_6, 0.0);
  EXPECT_EQ(found.share_long, 1.0);
}

TEST(ScanAgreement, CountsBeamsThatStopAtThingsNotDrawn) {
  const ScanAgreement found = agreement(scene({4.95F, 2.0F, 4.9F, 30.0F}, 0.0, 1e-3));
  EXPECT_EQ(found.returns, 3U);
  EXPECT_NEAR(found.share_short, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(found.share_within_0_1, 2.0 / 3.0, 1e-12);
}

TEST(ScanAgreement, KnowsAMirroredScanFromATrueOne) {
  // Turned to the left, the robot sees the wall to its right; mirrored, the beam ends in the open.
  Scene turned = scene({4.95F}, -kPi / 4.0, 0.1);
  turned.reference.poses[0].sketch_from_robot =
      Sim2::from_xy_yaw_scale(50.5, 50.5, kPi / 4.0, 10.0);
  EXPECT_EQ(agreement(turned).share_near_stroke, 1.0);
  EXPECT_EQ(agreement(turned).share_near_stroke_mirrored, 0.0);
}

TEST(ScanAgreement, LooksFromWhereTheLaserIs) {
  Scene ahead = scene({4.0F}, 0.0, 0.1);
  ahead.run.steps[0].scan.robot_from_laser = Se2::from_xy_yaw(0.95, 0.0, 0.0);
  EXPECT_NEAR(agreement(ahead).median_log_ratio, 0.0, 1e-5);
}

TEST(ScanAgreement, LeavesOutPosesThatAreNotScored) {
  Scene outside = scene({4.95F}, 0.0, 0.1);
  outside.reference.poses[0].scored = false;
  EXPECT_EQ(agreement(outside).returns, 0U);
}

TEST(ScanAgreement, HasQuartilesOfTheLogRatios) {
  std::vector<float> ranges_m;
  for (const double log_ratio : {0.65, 0.0, -0.65, 1.3, -1.3}) {
    ranges_m.push_back(static_cast<float>(4.95 * std::exp(log_ratio)));
  }
  const ScanAgreement found = agreement(scene(ranges_m, 0.0, 1e-6));
  EXPECT_NEAR(found.median_log_ratio, 0.0, 1e-4);
  EXPECT_NEAR(found.log_ratio_p25, -0.65, 1e-4);
  EXPECT_NEAR(found.log_ratio_p75, 0.65, 1e-4);
  EXPECT_NEAR(found.share_short, 0.4, 1e-12);
  EXPECT_NEAR(found.share_long, 0.4, 1e-12);
}

TEST(ScanAgreement, IsNanWithoutReturns) {
  const ScanAgreement found = agreement(scene({30.0F}, 0.0, 0.1));
  EXPECT_EQ(found.returns, 0U);
  EXPECT_TRUE(std::isnan(found.median_log_ratio));
  EXPECT_TRUE(std::isnan(found.share_near_stroke_mirrored));
}

TEST(ScanAgreement, IsNearlyPerfectOnTheTrueMap) {
  DataSetParams params{.person = std::nullopt};
  params.drive.length_m = 15.0;
  const DataSet data_set = generate_data_set(params, 1);
  const ScanAgreement found =
      measure_agreement(data_set.drawing.sketch, data_set.run, data_set.reference);
  EXPECT_GT(found.share_within_0_1, 0.97);
  EXPECT_GT(found.share_near_stroke, 0.98);
  EXPECT_LT(found.share_near_stroke_mirrored, 0.9);
}

// The figures of docs/results/simulator.md for two real drawings.
struct RealRun {
  std::string drawing;
  std::string log;
  std::string reference;
  double share_near_stroke;
  double share_near_stroke_mirrored;
  double share_within_0_3;
};

class RealRuns : public ::testing::TestWithParam<RealRun> {};

TEST_P(RealRuns, HaveTheAgreementThatTheDocumentsState) {
  const auto drawing = testing::shared_data(GetParam().drawing);
  const auto log = testing::shared_data(GetParam().log);
  const auto csv = testing::shared_data(GetParam().reference);
  if (!drawing || !log || !csv) {
    GTEST_SKIP() << "needs the shared development data";
  }
  const Sketch sketch = read_sketch(*drawing);
  const ScanAgreement found =
      measure_agreement(sketch, read_run(*log), read_reference(*csv, sketch.height_px()));
  EXPECT_NEAR(found.share_near_stroke, GetParam().share_near_stroke, 0.02);
  EXPECT_NEAR(found.share_near_stroke_mirrored, GetParam().share_near_stroke_mirrored, 0.03);
  EXPECT_NEAR(found.share_within_0_3, GetParam().share_within_0_3, 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealRuns,
    ::testing::Values(RealRun{"sketches/intel_sketch_3_rot180.png", "logs/intel.log.gz",
                              "references/intel_sketch_3_rot180/reference.csv", 0.72, 0.60, 0.44},
                      RealRun{"sketches/belgioioso_sketch.png", "logs/belgioioso.log.gz",
                              "references/belgioioso_sketch/reference.csv", 0.50, 0.40, 0.29}));

}  // namespace
}  // namespace sketchloc

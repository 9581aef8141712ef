#include "tests/support/shared_data.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/relations_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;
using testing::shared_data;
using Kind = Sketch::Kind;

/// The development data as a whole are there or not.
class RealData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!shared_data("")) {
      GTEST_SKIP() << "the development data are not here; set SKETCHLOC_DATA";
    }
  }
  static std::filesystem::path path(const std::filesystem::path& relative) {
    return shared_data(relative).value();
  }
  static std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> pictures;
    for (const auto& entry : std::filesystem::directory_iterator(path(folder))) {
      if (entry.path().extension() == ".png") {
        pictures.push_back(entry.path());
      }
    }
    return pictures;
  }
  static double occupied_share(const Sketch& sketch) {
    double occupied = 0.0;
    for (const std::uint8_t cell : sketch.occupied.cells()) {
      occupied += cell;
    }
    return occupied / static_cast<double>(sketch.occupied.cells().size());
  }
};

/// Those that take longer than a unit test may.
class RealDataEndToEnd : public RealData {};

TEST_F(RealDataEndToEnd, LogsHaveAllTheirScans) {
  const auto steps = [](const char* log) { return read_run(path(log)).steps.size(); };
  EXPECT_EQ(steps("logs/intel.log.gz"), 910U);
  EXPECT_EQ(steps("logs/belgioioso.log.gz"), 395U);
  EXPECT_EQ(steps("logs/fr079.log.gz"), 4791U);
  EXPECT_EQ(steps("logs/fr101.log.gz"), 292U);
  EXPECT_EQ(steps("logs/csail.log.gz"), 406U);
  EXPECT_EQ(steps("logs/fr101_carmen_corrected.log.gz"), 292U);
  EXPECT_EQ(steps("logs/csail_flirtlib.log.gz"), 1051U);
}

TEST_F(RealData, IntelLogGivesItsRawOdometry) {
  const RunStep step = read_run(path("logs/intel.log.gz")).steps[0];
  EXPECT_EQ(step.scan.ranges_m.size(), 180U);
  EXPECT_DOUBLE_EQ(step.scan.first_angle_rad, -std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(step.scan.angle_step_rad, std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(step.scan.time_s, 976052890.244111);
  EXPECT_THAT(step.odom_from_robot, IsNear(Se2::from_xy_yaw(0.698, -0.015, -0.463373), 1e-9));
}

TEST_F(RealData, CarmenParametersAndRobotLaserColumnsSetTheMaximumRange) {
  EXPECT_EQ(read_run(path("logs/fr101_carmen_corrected.log.gz")).steps[0].scan.max_range_m, 80.99);
  EXPECT_EQ(read_run(path("logs/csail_flirtlib.log.gz")).steps[0].scan.max_range_m, 50.0);
  EXPECT_EQ(read_run(path("logs/csail.log.gz")).steps[0].scan.max_range_m, 80.0);
}

TEST_F(RealDataEndToEnd, DrawingsOfPeopleAreReadAsStrokes) {
  for (const char* name : {"intel_sketch_3_rot180.png", "belgioioso_sketch.png"}) {
    const Sketch sketch = read_sketch(path(std::filesystem::path("sketches") / name));
    EXPECT_EQ(sketch.kind, Kind::Strokes) << name;
    EXPECT_GT(occupied_share(sketch), 0.03) << name;
    EXPECT_LT(occupied_share(sketch), 0.08) << name;
  }
}

TEST_F(RealDataEndToEnd, PaintedDrawingsModelsAndMapsAreReadAsFreeSpace) {
  std::vector<std::filesystem::path> pictures = {path("sketches/intel_model.png"),
                                                 path("sketches/belgioioso_model.png")};
  for (const char* folder : {"sketches/kth", "maps"}) {
    std::ranges::copy(pictures_in(folder), std::back_inserter(pictures));
  }
  EXPECT_GE(pictures.size(), 32U);
  for (const std::filesystem::path& picture : pictures) {
    const Sketch sketch = read_sketch(picture);
    EXPECT_EQ(sketch.kind, Kind::FilledFreeSpace) << picture;
    EXPECT_GT(occupied_share(sketch), 0.2) << picture;
    EXPECT_LT(occupied_share(sketch), 0.96) << picture;
  }
}

TEST_F(RealDataEndToEnd, LargePlansAreReadAsFreeSpace) {
  for (const std::filesystem::path& picture : pictures_in("maps/plans")) {
    const Sketch sketch = read_sketch(picture);
    EXPECT_EQ(sketch.kind, Kind::FilledFreeSpace) << picture;
    EXPECT_LT(occupied_share(sketch), 0.995) << picture;
  }
}

TEST_F(RealData, ReferencesAreTurnedIntoTheSketchFrame) {
  const Reference reference =
      read_reference(path("references/intel_sketch_3_rot180/reference.csv"), 679);
  ASSERT_EQ(reference.poses.size(), 910U);
  const ReferencePose& first = reference.poses[0];
  EXPECT_THAT(first.sketch_from_robot,
              IsNear(Sim2::from_xy_yaw_scale(1111.93, 679 - 0.5 - 560.76, 2.66318, 14.590), 1e-9));
  EXPECT_DOUBLE_EQ(first.uncertainty_m, 0.738);
  EXPECT_TRUE(first.scored);
  const auto alternative =
      read_alternative(path("references/belgioioso_sketch/reference_alternative_B.csv"), 617);
  EXPECT_EQ(alternative.size(), 395U);
}

TEST_F(RealDataEndToEnd, RelationsAndWarehouseTrajectoriesAreRead) {
  EXPECT_EQ(read_relations(path("relations/intel.relations")).size(), 2984U);
  EXPECT_EQ(read_relations(path("relations/fr079.relations")).size(), 1685U);
  EXPECT_EQ(read_tum(path("warehouse/W-1.1/unopt.tum")).size(), 2800U);
  EXPECT_EQ(read_tum(path("warehouse/W-2.1/gt.tum")).size(), 2078U);
}

}  // namespace
}  // namespace sketchloc

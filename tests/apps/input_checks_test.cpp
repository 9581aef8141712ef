#include "apps/input_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Sketch empty_sheet() { return {.occupied = Grid<std::uint8_t>(120, 80), .px_per_m = std::nullopt}; }

Sketch room(int gap_px) {
  Sketch sketch = empty_sheet();
  for (int column = 10; column <= 110; ++column) {
    sketch.occupied.at({column, 10}) = column < 20 + gap_px && column >= 20 ? 0 : 1;
    sketch.occupied.at({column, 70}) = 1;
  }
  for (int row = 10; row <= 70; ++row) {
    sketch.occupied.at({10, row}) = 1;
    sketch.occupied.at({110, row}) = 1;
  }
  return sketch;
}

sketchloc::Run run_with_ranges(const std::vector<float>& ranges_m) {
  sketchloc::Run run;
  for (int i = 0; i < 3; ++i) {
    Scan scan{.time_s = 1.0 * i, .max_range_m = 30.0, .robot_from_laser = {}, .ranges_m = ranges_m};
    run.steps.push_back({.scan = std::move(scan), .odom_from_robot = {}});
  }
  return run;
}

TEST(InputChecks, FindNoFaultWithARoomThatHasADoor) {
  EXPECT_THAT(doubts_about(room(0)), IsEmpty());
  EXPECT_THAT(doubts_about(room(6)), IsEmpty());
}

TEST(InputChecks, DoubtADrawingThatEnclosesNothingOrIsNoise) {
  Sketch lines = empty_sheet();
  for (int column = 10; column <= 110; ++column) {
    lines.occupied.at({column, 40}) = 1;
  }
  EXPECT_THAT(doubts_about(lines), ElementsAre(HasSubstr("no place with strokes around it")));
  Sketch noise = room(0);
  for (int row = 1; row < 80; row += 2) {
    for (int column = 1; column < 120; column += 2) {
      noise.occupied.at({column, row}) = 1;
    }
  }
  EXPECT_THAT(doubts_about(noise), ElementsAre(HasSubstr("separate strokes; is it a photo")));
}

TEST(InputChecks, DoubtALogWithoutReturnsOrInMillimetres) {
  EXPECT_THAT(doubts_about(run_with_ranges({1.0F, 2.0F, 40.0F})), IsEmpty());
  EXPECT_THAT(doubts_about(run_with_ranges({0.0F, -1.0F})),
              ElementsAre(HasSubstr("no scan has a return")));
  EXPECT_THAT(doubts_about(run_with_ranges({2500.0F, 1300.0F})),
              ElementsAre(HasSubstr("no scan has a return"), HasSubstr("in mm instead of m")));
}

TEST(InputChecks, CompareAReferenceWithTheScans) {
  const std::array<double, 3> scan_times_s = {0.0, 1.0, 2.0};
  Reference reference;
  for (const std::size_t step : {0U, 1U, 2U}) {
    reference.poses.push_back(
        {.step = step, .time_s = 1.0 * static_cast<double>(step), .sketch_from_robot = {}});
  }
  EXPECT_THAT(doubts_about(reference, scan_times_s), IsEmpty());
  EXPECT_FALSE(is_of_another_run(reference, scan_times_s));
  reference.poses.push_back({.step = 3, .time_s = 3.0, .sketch_from_robot = {}});
  EXPECT_THAT(doubts_about(reference, scan_times_s), ElementsAre(HasSubstr("1 poses for scans")));
  reference.poses.resize(1);
  EXPECT_THAT(doubts_about(reference, scan_times_s), ElementsAre(HasSubstr("1 of the 3 scans")));
  reference.poses[0].time_s = 0.5;
  EXPECT_TRUE(is_of_another_run(reference, scan_times_s));
}

}  // namespace
}  // namespace sketchloc

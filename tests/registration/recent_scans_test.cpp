#include "registration/recent_scans.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

Scan scan_at(double time_s) {
  Scan scan;
  scan.time_s = time_s;
  return scan;
}

Se2 at(double x_m) { return Se2::from_xy_yaw(x_m, 0.0, 0.0); }

TEST(RecentScans, StartsWithThePresentScanInItsOwnPlace) {
  RecentScans recent;
  EXPECT_TRUE(recent.placed().empty());
  recent.add(scan_at(1.0), at(5.0));
  ASSERT_EQ(recent.placed().size(), 1U);
  EXPECT_EQ(recent.placed().front().scan->time_s, 1.0);
  EXPECT_THAT(recent.placed().front().robot_from_then, IsNear(Se2(), 1e-12));
}

TEST(RecentScans, RemembersScansAtTheirSpacing) {
  RecentScans recent({.max_scans = 10, .spacing_m = 1.0});
  for (int i = 0; i <= 32; ++i) {
    recent.add(scan_at(i), at(0.1 * i));
  }
  std::vector<double> times_s;
  for (const PlacedScan& placed : recent.placed()) {
    times_s.push_back(placed.scan->time_s);
  }
  EXPECT_EQ(times_s, (std::vector<double>{32.0, 30.0, 20.0, 10.0, 0.0}));
  EXPECT_THAT(recent.placed()[2].robot_from_then, IsNear(at(-1.2), 1e-9));
}

TEST(RecentScans, ForgetsTheOldest) {
  RecentScans recent({.max_scans = 3, .spacing_m = 0.5});
  for (int i = 0; i < 10; ++i) {
    recent.add(scan_at(i), at(i));
  }
  ASSERT_EQ(recent.placed().size(), 3U);
  EXPECT_EQ(recent.placed().back().scan->time_s, 7.0);
}

TEST(RecentScans, RemembersAScanThatLooksElsewhere) {
  RecentScans recent({.max_turn_rad = 1.0});
  recent.add(scan_at(0.0), at(0.0));
  recent.add(scan_at(1.0), Se2::from_xy_yaw(0.0, 0.0, 1.5));
  recent.add(scan_at(2.0), Se2::from_xy_yaw(0.0, 0.0, 1.6));
  EXPECT_EQ(recent.placed().size(), 3U);
}

TEST(RecentScans, RefusesParametersOutOfRange) {
  EXPECT_THROW(RecentScans({.max_scans = 0}), std::invalid_argument);
  EXPECT_THROW(RecentScans({.spacing_m = -1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

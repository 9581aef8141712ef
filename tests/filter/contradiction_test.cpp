#include "filter/contradiction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace sketchloc {
namespace {

/// All around; what a robot sees from a place in a round room of a radius, by cosine rule.
Scan scan_in_round_room(double radius_m, double x_m, double yaw_rad = 0.0) {
  Scan scan{.first_angle_rad = -std::numbers::pi,
            .angle_step_rad = std::numbers::pi / 180.0,
            .max_range_m = 30.0,
            .robot_from_laser = {},
            .ranges_m = {}};
  for (std::size_t beam = 0; beam < 360; ++beam) {
    const double along_m = x_m * std::cos(yaw_rad + scan.angle_rad(beam));
    scan.ranges_m.push_back(static_cast<float>(
        -along_m + std::sqrt(along_m * along_m + radius_m * radius_m - x_m * x_m)));
  }
  return scan;
}

TEST(Contradiction, IsNoneForARobotThatMovesAsTheOdometrySays) {
  EXPECT_EQ(contradiction(scan_in_round_room(4.0, 1.0, 0.7), scan_in_round_room(4.0, 0.0),
                          Se2::from_xy_yaw(1.0, 0.0, 0.7)),
            0.0);
}

TEST(Contradiction, IsHalfWhereOneOfTwoScansEndsInTheFreeSpaceOfTheOther) {
  // The small room's wall stands in the large room; the large one's is out of the small one's
  // sight.
  EXPECT_NEAR(contradiction(scan_in_round_room(2.0, 0.0), scan_in_round_room(6.0, 0.0), Se2()), 0.5,
              1e-9);
}

TEST(Contradiction, ForgivesWhatIsWithinTheTolerance) {
  const Scan near = scan_in_round_room(2.0, 0.0);
  const Scan far = scan_in_round_room(2.6, 0.0);  // 0.6 m, of which 0.5 m + 10 % of 2 m are fine
  EXPECT_EQ(contradiction(near, far, Se2()), 0.0);
  EXPECT_NEAR(contradiction(near, far, Se2(), {.tolerance_m = 0.3}), 0.5, 1e-9);
}

TEST(Contradiction, IsNoneWhereNothingIsSeenTwice) {
  Scan blind = scan_in_round_room(2.0, 0.0);
  for (float& range_m : blind.ranges_m) {
    range_m = std::numeric_limits<float>::quiet_NaN();
  }
  EXPECT_EQ(contradiction(blind, scan_in_round_room(6.0, 0.0), Se2()), 0.0);
  EXPECT_EQ(contradiction(Scan{}, blind, Se2()), 0.0);
}

TEST(ContradictionParams, RefuseWhatIsOutOfRange) {
  EXPECT_THROW(validate(ContradictionParams{.tolerance_m = -0.1}), std::invalid_argument);
  EXPECT_THROW(validate(ContradictionParams{.neighbours = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

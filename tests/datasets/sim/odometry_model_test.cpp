#include "datasets/sim/odometry_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

constexpr OdometryNoise kNoNoise = {
    .slip_m_per_m = 0.0, .slip_m_per_rad = 0.0, .turn_rad_per_m = 0.0, .turn_rad_per_rad = 0.0};

TEST(OdometrySimulator, IsTrueWithoutBiasAndNoise) {
  Rng rng = make_rng(1);
  const OdometryModel perfect = {.length_bias_sigma = 0.0,
                                 .turn_bias_sigma_rad_per_m = 0.0,
                                 .turn_bias_sigma = 0.0,
                                 .noise = kNoNoise};
  const OdometrySimulator odometry(perfect, rng);
  const Se2 robot_from_next = Se2::from_xy_yaw(0.4, 0.02, -0.3);
  EXPECT_THAT(odometry.measured(robot_from_next, rng), IsNear(robot_from_next, 1e-12));
}

TEST(OdometrySimulator, KeepsItsBiasForTheWholeRun) {
  Rng rng = make_rng(2);
  const OdometrySimulator odometry({.noise = kNoNoise}, rng);
  const Se2 robot_from_next = Se2::from_xy_yaw(0.5, 0.0, 0.2);
  const Se2 once = odometry.measured(robot_from_next, rng);
  EXPECT_THAT(odometry.measured(robot_from_next, rng), IsNear(once, 1e-12));
  EXPECT_GT(std::abs(once.x_m() - 0.5), 1e-4);
}

TEST(OdometrySimulatorStatistical, DrawsItsBiasFromTheModel) {
  const OdometryModel model = {.length_bias_sigma = 0.04, .noise = kNoNoise};
  const Se2 one_metre = Se2::from_xy_yaw(1.0, 0.0, 0.0);
  double squared_lengths = 0.0;
  double squared_turns = 0.0;
  constexpr int kRuns = 4000;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    Rng rng = make_rng(run);
    const Se2 measured = OdometrySimulator(model, rng).measured(one_metre, rng);
    squared_lengths += std::pow(measured.x_m() - 1.0, 2);
    squared_turns += std::pow(measured.yaw_rad(), 2);
  }
  const double tolerance = 5.0 / std::sqrt(2.0 * kRuns);  // relative, of a standard deviation
  EXPECT_NEAR(std::sqrt(squared_lengths / kRuns) / 0.04, 1.0, tolerance);
  EXPECT_NEAR(std::sqrt(squared_turns / kRuns) / model.turn_bias_sigma_rad_per_m, 1.0, tolerance);
}

TEST(OdometryModel, RejectsValuesOutOfRangeByName) {
  EXPECT_NO_THROW(validate(OdometryModel{}));
  EXPECT_THROW(validate(OdometryModel{.turn_bias_sigma = -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

#include "registration/train/validation.hpp"

#include <gtest/gtest.h>

namespace sketchloc {
namespace {

TEST(ValidationErrors, MeasuresInTrueLocalMetres) {
  ValidationErrors errors;
  const Sim2 truth = Sim2::from_xy_yaw_scale(100.0, 100.0, 0.0, 20.0);
  const Sim2 prior = Sim2::from_xy_yaw_scale(140.0, 100.0, 0.5, 10.0);
  errors.add(truth, prior, Sim2::from_xy_yaw_scale(100.0, 110.0, -0.1, 30.0));
  const ValidationReport report = errors.report();
  EXPECT_NEAR(report.prior_position_m.mean, 2.0, 1e-12);
  EXPECT_NEAR(report.position_m.mean, 0.5, 1e-12);
  EXPECT_NEAR(report.prior_heading_rad.median, 0.5, 1e-12);
  EXPECT_NEAR(report.heading_rad.median, 0.1, 1e-12);
  EXPECT_EQ(report.failures, 0);
}

TEST(ValidationErrors, CountsAFailureAsThePrior) {
  ValidationErrors errors;
  const Sim2 truth = Sim2::from_xy_yaw_scale(100.0, 100.0, 0.0, 20.0);
  errors.add(truth, Sim2::from_xy_yaw_scale(140.0, 100.0, 0.5, 10.0), std::nullopt);
  EXPECT_EQ(errors.report().failures, 1);
  EXPECT_NEAR(errors.report().position_m.mean, 2.0, 1e-12);
}

TEST(ValidationErrors, IsEmptyWithoutPoses) { EXPECT_EQ(ValidationErrors{}.report().samples, 0); }

}  // namespace
}  // namespace sketchloc

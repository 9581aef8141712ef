#include "eval/sketch_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "motion/angles.hpp"

namespace sketchloc {
namespace {

constexpr double kTolerance = 1e-12;

StepReport report_at(std::size_t step, const Sim2& sketch_from_robot,
                     const Eigen::Matrix4d& covariance = Eigen::Matrix4d::Identity()) {
  StepReport report;
  report.step = step;
  report.time_s = 100.0 + static_cast<double>(step);
  report.estimate.sketch_from_robot = sketch_from_robot;
  report.estimate.covariance = covariance;
  return report;
}

ReferencePose reference_at(std::size_t step, double x_px, double px_per_m = 10.0) {
  return {.step = step,
          .time_s = 100.0 + static_cast<double>(step),
          .sketch_from_robot = Sim2::from_xy_yaw_scale(x_px, 0.0, 0.0, px_per_m)};
}

/// One pose per metre driven, each off sideways by the given number of metres.
std::vector<StepError> errors_with(const std::vector<double>& offsets_m) {
  Reference reference;
  std::vector<StepReport> reports;
  for (std::size_t step = 0; step < offsets_m.size(); ++step) {
    reference.poses.push_back(reference_at(step, 10.0 * static_cast<double>(step)));
    reports.push_back(report_at(step, Sim2::from_xy_yaw_scale(10.0 * static_cast<double>(step),
                                                              10.0 * offsets_m[step], 0.0, 10.0)));
  }
  return step_errors(reports, reference);
}

// 30 px right and 40 px up of the reference, where one metre is drawn as 20 px: 50 px, 2.5 m.
TEST(StepErrors, AreInPixelsAndInLocalMetres) {
  const Reference reference{.poses = {reference_at(7, 100.0, 20.0)}};
  const std::vector<StepReport> reports = {
      report_at(7, Sim2::from_xy_yaw_scale(130.0, 40.0, rad_from_deg(-30.0), 25.0))};
  const std::vector<StepError> errors = step_errors(reports, reference);
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_NEAR(errors[0].translation_px, 50.0, kTolerance);
  EXPECT_NEAR(errors[0].translation_m, 2.5, kTolerance);
  EXPECT_NEAR(errors[0].heading_rad, rad_from_deg(30.0), kTolerance);
  EXPECT_NEAR(errors[0].scale_ratio, 1.25, kTolerance);
}

TEST(StepErrors, LeaveOutStepsWithoutAScoredReference) {
  Reference reference{.poses = {reference_at(0, 0.0), reference_at(2, 0.0)}};
  reference.poses[1].scored = false;
  const std::vector<StepReport> reports = {report_at(0, Sim2()), report_at(1, Sim2()),
                                           report_at(2, Sim2())};
  const std::vector<StepError> errors = step_errors(reports, reference);
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].step, 0U);
}

TEST(StepErrors, TurnTheShortWayAround) {
  Reference reference{.poses = {reference_at(0, 0.0)}};
  reference.poses[0].sketch_from_robot = Sim2::from_xy_yaw_scale(0, 0, rad_from_deg(179.0), 10.0);
  const std::vector<StepReport> reports = {
      report_at(0, Sim2::from_xy_yaw_scale(0, 0, rad_from_deg(-178.0), 10.0))};
  EXPECT_NEAR(step_errors(reports, reference)[0].heading_rad, rad_from_deg(3.0), kTolerance);
}

// 40 px from the reference (4 m at 10 px/m), 10 px from the alternative (0.5 m at 20 px/m).
TEST(StepErrors, TakeTheNearerPositionButTheHeadingOfTheFirstReference) {
  const Reference reference{.poses = {reference_at(0, 0.0, 10.0)}};
  Reference alternative{.poses = {reference_at(0, 50.0, 20.0)}};
  alternative.poses[0].sketch_from_robot = Sim2::from_xy_yaw_scale(50.0, 0.0, 0.3, 20.0);
  const std::vector<StepReport> reports = {
      report_at(0, Sim2::from_xy_yaw_scale(40.0, 0.0, 0.3, 10.0))};
  const std::vector<Reference> alternatives = {alternative};
  const std::vector<StepError> errors = step_errors(reports, reference, alternatives);
  EXPECT_NEAR(errors[0].translation_m, 0.5, kTolerance);
  EXPECT_NEAR(errors[0].translation_px, 10.0, kTolerance);
  EXPECT_NEAR(errors[0].heading_rad, 0.3, kTolerance);
}

// From 10 to 20 px/m over 30 px: 30 px at the mean scale of 15 px/m are 2 m.
TEST(StepErrors, MeasureTheWayByTheLocalScale) {
  const Reference reference{.poses = {reference_at(0, 0.0, 10.0), reference_at(1, 30.0, 20.0)}};
  const std::vector<StepReport> reports = {report_at(0, Sim2()), report_at(1, Sim2())};
  EXPECT_NEAR(step_errors(reports, reference)[1].driven_m, 2.0, kTolerance);
}

// sigma = 20 px along x at 10 px/m; error 60 px along x; the reference adds (1 m)^2 = 100 px^2:
// NEES = 3600 / (400 + 100) = 7.2.
TEST(StepErrors, CompareTheErrorWithBothUncertainties) {
  Reference reference{.poses = {reference_at(0, 0.0, 10.0)}};
  reference.poses[0].uncertainty_m = 1.0;
  const Eigen::Matrix4d covariance = Eigen::Vector4d(400.0, 4.0, 0.01, 0.01).asDiagonal();
  const std::vector<StepReport> reports = {
      report_at(0, Sim2::from_xy_yaw_scale(60.0, 0.0, 0.0, 10.0), covariance)};
  const std::vector<StepError> errors = step_errors(reports, reference);
  EXPECT_NEAR(errors[0].stated_sigma_m, 2.0, kTolerance);
  EXPECT_NEAR(errors[0].position_nees.value(), 7.2, kTolerance);
}

TEST(FirstLoss, IsWhereTheErrorBeginsToStayBeyondTheBound) {
  // 3.5 m off at step 1 recovers; from step 4 on it stays off for 5 m of driving.
  const auto errors = errors_with({0, 3.5, 0, 0, 4, 4, 4, 4, 4, 4, 0, 0});
  const auto loss = first_loss(errors);
  ASSERT_TRUE(loss.has_value());
  EXPECT_EQ(loss->step, 4U);
}

TEST(FirstLoss, IsNoneWhereTheFilterRecoversSooner) {
  EXPECT_FALSE(first_loss(errors_with({0, 4, 4, 4, 4, 4, 0, 0})).has_value());
  EXPECT_FALSE(first_loss(errors_with({0, 3, 3, 3, 3, 3, 3, 3, 3})).has_value());
  EXPECT_FALSE(first_loss({}).has_value());
}

TEST(FirstLoss, CountsWhatIsStillBeyondTheBoundAtTheEnd) {
  const auto loss = first_loss(errors_with({0, 0, 4, 4}));
  ASSERT_TRUE(loss.has_value());
  EXPECT_EQ(loss->step, 2U);
}

TEST(FirstLoss, SaysWhichParameterIsOutOfRange) {
  EXPECT_THROW(first_loss({}, {.bound_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(first_loss({}, {.lasting_m = -1.0}), std::invalid_argument);
}

TEST(SketchErrors, SummarizeARunWorkedOutByHand) {
  const SketchErrors summary = summarize_sketch_errors(errors_with({0.5, 1.0, 1.5, 4.0}));
  EXPECT_EQ(summary.scored, 4U);
  EXPECT_DOUBLE_EQ(summary.share_within_1_m, 0.5);
  EXPECT_DOUBLE_EQ(summary.share_within_2_m, 0.75);
  EXPECT_FALSE(summary.share_within_uncertainty);  // an exact reference has none
  EXPECT_NEAR(summary.translation_m->median, 1.25, kTolerance);
  EXPECT_NEAR(summary.translation_px->max, 40.0, kTolerance);
  EXPECT_NEAR(summary.median_scale_ratio, 1.0, kTolerance);
  EXPECT_TRUE(summary.lost_at_end);
  EXPECT_DOUBLE_EQ(summary.first_loss_s.value(), 3.0);
}

TEST(SketchErrors, OfNothingAreNone) {
  const SketchErrors summary = summarize_sketch_errors({});
  EXPECT_EQ(summary.scored, 0U);
  EXPECT_FALSE(summary.translation_m.has_value());
  EXPECT_FALSE(summary.lost_at_end);
}

}  // namespace
}  // namespace sketchloc

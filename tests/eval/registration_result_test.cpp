#include "eval/registration_result.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "eval/predictors.hpp"
#include "eval/registration_report.hpp"
#include "registration/control_grid.hpp"
#include "tests/eval/synthetic_run.hpp"
#include "tests/support/markup.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::markup_faults;
using ::testing::Not;

/// A robot at (100 px, 50 px) that looks up in a drawing of 20 px/m, found without bending.
RegistrationResult example() {
  const Sim2 pose = Sim2::from_xy_yaw_scale(100.0, 50.0, 0.5 * std::numbers::pi, 20.0);
  const std::vector<Eigen::Vector2d> points = square_lattice(4, 16.0, {0.0, 0.0});
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : points) {
    places.push_back(pose * point);
  }
  RegistrationResult result{
      .step = 7,
      .time_s = 3.5,
      .scans = 2,
      .window = {},
      .prior_sketch_from_robot = Sim2::from_xy_yaw_scale(100.0, 20.0, std::numbers::pi, 10.0),
      .registration = std::nullopt};
  result.registration = Registration{.warp = *Warp::from_robot_points(points, places),
                                     .sketch_from_robot = pose,
                                     .covariance = Eigen::Matrix4d::Identity() * 0.25,
                                     .inlier_probability = 0.75};
  return result;
}

TEST(RegistrationResult, MeasuresDifferencesInTheMetresOfTheOtherPose) {
  const PoseDifference found = difference(Sim2::from_xy_yaw_scale(30.0, 40.0, -3.0, 20.0),
                                          Sim2::from_xy_yaw_scale(0.0, 0.0, 3.0, 10.0));
  EXPECT_DOUBLE_EQ(found.shift_m, 5.0);
  EXPECT_NEAR(found.turn_rad, 2.0 * std::numbers::pi - 6.0, 1e-12);
  EXPECT_DOUBLE_EQ(found.scale_ratio, 2.0);
}

TEST(RegistrationResult, StatesSigmaAlongTheWorstDirection) {
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
  covariance.topLeftCorner<2, 2>() << 2.5, 1.5, 1.5, 2.5;  // eigenvalues 1 and 4
  covariance(2, 2) = 0.09;
  EXPECT_NEAR(sigma_of(covariance).position_m, 2.0, 1e-12);
  EXPECT_NEAR(sigma_of(covariance).heading_rad, 0.3, 1e-12);
}

TEST(RegistrationResult, WritesPoseCovarianceAndControlPoints) {
  RegistrationResult result = example();
  result.reference = ReferencePose{.step = 7,
                                   .time_s = 3.5,
                                   .sketch_from_robot = result.registration->sketch_from_robot,
                                   .uncertainty_m = 0.5};
  const std::vector<NamedText> inputs = {{"map", "a \"b\".png"}};
  const auto json = nlohmann::json::parse(to_json(result, inputs));
  EXPECT_EQ(json["scan"], 7);
  EXPECT_EQ(json["scans"], 2);
  EXPECT_DOUBLE_EQ(json["pose"]["x_px"], 100.0);
  EXPECT_DOUBLE_EQ(json["from_prior"]["shift_m"], 3.0);
  EXPECT_NEAR(json["from_prior"]["turn_deg"].get<double>(), -90.0, 1e-9);
  EXPECT_DOUBLE_EQ(json["covariance"]["matrix"][3][3], 0.25);
  EXPECT_DOUBLE_EQ(json["inlier_probability"], 0.75);
  EXPECT_FALSE(json["warp"]["folds"]);
  EXPECT_NEAR(json["warp"]["min_determinant_px2_per_m2"].get<double>(), 400.0, 1e-6);
  ASSERT_EQ(json["warp"]["control_points"].size(), 16U);
  const auto& first = json["warp"]["control_points"][0];  // behind the robot, to its right
  EXPECT_DOUBLE_EQ(first["x_m"], -8.0);
  EXPECT_NEAR(first["x_px"].get<double>(), 260.0, 1e-6);
  EXPECT_NEAR(first["y_px"].get<double>(), -110.0, 1e-6);
  EXPECT_DOUBLE_EQ(json["error"]["pose"]["shift_m"], 0.0);
  EXPECT_DOUBLE_EQ(json["error"]["prior"]["shift_m"], 1.5);
  EXPECT_EQ(json["inputs"]["map"], "a \"b\".png");
}

TEST(RegistrationResult, HasAllKeysWhereNothingWasFound) {
  RegistrationResult result = example();
  const auto found = nlohmann::json::parse(to_json(result, {}));
  result.registration.reset();
  const auto none = nlohmann::json::parse(to_json(result, {}));
  for (const auto& [key, value] : found.items()) {
    EXPECT_TRUE(none.contains(key)) << key;
  }
  EXPECT_TRUE(none["pose"].is_null());
  EXPECT_TRUE(none["warp"].is_null());
}

TEST(RegistrationReport, IsWellFormedAndEscapesWhatComesFromOutside) {
  const RunRecord record = testing::make_synthetic_run(testing::Outcome::Located);
  const std::vector<PlacedScan> submap = {{.scan = &record.run.steps.front().scan}};
  RegistrationResult result = example();
  const std::vector<NamedText> inputs = {{"drawing", "<b>&.png"}};
  for (int found = 1; found >= 0; --found) {
    const RegistrationView view{.sketch = &record.sketch,
                                .submap = submap,
                                .prior_sketch_from_robot = result.prior_sketch_from_robot,
                                .registration = found ? &*result.registration : nullptr};
    const std::string page = registration_html(view, result, inputs);
    EXPECT_THAT(markup_faults(page), IsEmpty());
    EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;.png"));
    EXPECT_THAT(page, Not(HasSubstr("http:")));
    result.registration.reset();
  }
}

TEST(Predictors, SayWhatIsWrongWithANetwork) {
  const std::vector<std::uint8_t> noise = {1, 2, 3};
  EXPECT_THROW(make_predictor(RegistrationMethod::Ours, noise), std::runtime_error);
  EXPECT_THROW(make_predictor(RegistrationMethod::Icp, noise), std::invalid_argument);
}

TEST(Predictors, OfThePublishedKindTakeOneScan) {
  EXPECT_TRUE(takes_one_scan(RegistrationMethod::Chen20));
  EXPECT_TRUE(takes_one_scan(RegistrationMethod::Affine));
  EXPECT_FALSE(takes_one_scan(RegistrationMethod::Ours));
  EXPECT_EQ(network_of(RegistrationMethod::Affine), NetworkKind::Affine);
  EXPECT_FALSE(network_of(RegistrationMethod::Icp).has_value());
}

}  // namespace
}  // namespace sketchloc

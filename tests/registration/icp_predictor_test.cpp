#include "registration/icp_predictor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion/angles.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/simulated_scan.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using testing::IsNear;

constexpr double kPxPerM = 20.0;

void draw_line(Grid<std::uint8_t>& occupied, const Eigen::Vector2d& from,
               const Eigen::Vector2d& to) {
  const int steps = static_cast<int>(std::ceil(2.0 * (to - from).norm()));
  for (int step = 0; step <= steps; ++step) {
    occupied.at(cell_at(from + (to - from) * step / steps)) = 1;
  }
}

/// A room of 9 m x 7 m with a slanting corner, a niche and a block: no two places look alike.
Grid<std::uint8_t> room() {
  Grid<std::uint8_t> occupied(210, 170);
  const std::vector<std::vector<Eigen::Vector2d>> outlines = {
      {{15, 15},
       {195, 15},
       {195, 70},
       {180, 70},
       {180, 100},
       {195, 100},
       {195, 155},
       {90, 155},
       {15, 110},
       {15, 15}},
      {{120, 60}, {150, 60}, {150, 80}, {120, 80}, {120, 60}},
      {{60, 15}, {60, 45}}};
  for (const std::vector<Eigen::Vector2d>& outline : outlines) {
    for (std::size_t i = 1; i < outline.size(); ++i) {
      draw_line(occupied, outline[i - 1], outline[i]);
    }
  }
  return occupied;
}

/// What must be so in every build.
TEST(IcpPredictor, RefusesParametersOutOfRange) {
  EXPECT_NO_THROW(validate(IcpParams{}));
  EXPECT_THROW(validate(IcpParams{.side_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(IcpParams{.layers = 4}), std::invalid_argument);
  EXPECT_THROW(validate(IcpParams{.tuple_scale = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(IcpParams{.tuple_scale = 1.5}), std::invalid_argument);
  EXPECT_THROW(make_icp_predictor({.voxel_m = -1.0}), std::invalid_argument);
}

TEST(IcpPredictor, SaysHowToGetItWhereItIsNotBuilt) {
  if (icp_is_built()) {
    GTEST_SKIP() << "this build has it";
  }
  try {
    make_icp_predictor();
    FAIL() << "made a predictor";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("SKETCHLOC_OPEN3D"));
  }
}

class IcpPredictorOnATrueDrawing : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!icp_is_built()) {
      GTEST_SKIP() << "needs a build with SKETCHLOC_OPEN3D";
    }
  }

  static std::vector<Sim2> priors_around(const Sim2& truth) {
    std::vector<Sim2> priors;
    for (int i = 0; i < 8; ++i) {
      const double angle_rad = rad_from_deg(45.0 * i);
      priors.push_back(truth * Se2::from_xy_yaw(std::cos(angle_rad), std::sin(angle_rad),
                                                rad_from_deg(i % 2 == 0 ? 15.0 : -15.0)));
    }
    return priors;
  }

  const Grid<std::uint8_t> occupied_ = room();
  const SketchCropper drawing_{occupied_};
  const Sim2 truth_ = Sim2::from_xy_yaw_scale(90.0, 75.0, 0.4, kPxPerM);
  const Scan scan_ = testing::simulated_scan(occupied_, truth_, 720);
  const std::vector<PlacedScan> submap_ = {{.scan = &scan_}};
};

TEST_F(IcpPredictorOnATrueDrawing, FindsTheRobotFromMostPriors) {
  const std::vector<Sim2> priors = priors_around(truth_);
  const auto results = make_icp_predictor()->predict(submap_, drawing_, priors);
  ASSERT_EQ(results.size(), priors.size());
  int found = 0;
  for (const std::optional<Registration>& result : results) {
    if (!result) {
      continue;
    }
    const Sim2 error = truth_.inverse() * result->sketch_from_robot;
    const bool near =
        error.translation().norm() < 0.2 && std::abs(error.yaw_rad()) < rad_from_deg(3.0);
    found += near ? 1 : 0;
    EXPECT_GE(result->inlier_probability, near ? 0.8 : 0.0);
    EXPECT_LE(result->inlier_probability, 1.0);
    EXPECT_FALSE(result->covariance.has_value());
    ASSERT_TRUE(result->warp.pose().has_value());
    EXPECT_THAT(*result->warp.pose(), IsNear(result->sketch_from_robot, 1e-6));
    EXPECT_NEAR(result->sketch_from_robot.scale(), kPxPerM, 1e-9);  // the prior's
  }
  EXPECT_GE(found, 6);
}

TEST_F(IcpPredictorOnATrueDrawing, AnswersEachPriorTheSameWhateverCameBefore) {
  const std::vector<Sim2> priors = priors_around(truth_);
  const auto predictor = make_icp_predictor();
  const auto together = predictor->predict(submap_, drawing_, priors);
  for (std::size_t i : {3U, 1U}) {
    const auto alone = predictor->predict(submap_, drawing_, std::span(&priors[i], 1));
    ASSERT_EQ(alone[0].has_value(), together[i].has_value());
    if (alone[0]) {
      EXPECT_THAT(alone[0]->sketch_from_robot, IsNear(together[i]->sketch_from_robot, 0.0));
    }
  }
}

TEST_F(IcpPredictorOnATrueDrawing, FindsNothingWhereThereIsNothing) {
  Scan blind = scan_;
  for (float& range : blind.ranges_m) {
    range = 30.0F;
  }
  const std::vector<PlacedScan> nothing_seen = {{.scan = &blind}};
  const std::vector<Sim2> here = {truth_};
  const std::vector<Sim2> beside = {Sim2::from_xy_yaw_scale(5000.0, -3000.0, 0.0, kPxPerM)};
  const auto predictor = make_icp_predictor();
  EXPECT_FALSE(predictor->predict(nothing_seen, drawing_, here)[0].has_value());
  EXPECT_FALSE(predictor->predict(submap_, drawing_, beside)[0].has_value());
  EXPECT_TRUE(predictor->predict(submap_, drawing_, {}).empty());
}

}  // namespace
}  // namespace sketchloc

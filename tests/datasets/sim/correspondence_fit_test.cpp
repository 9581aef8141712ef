#include "datasets/sim/correspondence_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using Kind = CorrespondenceFit::Kind;
using Status = CorrespondenceFit::Status;

const PlaneBox kLayout = {{0.0, 0.0}, {10.0, 8.0}};

template <typename Map>
std::vector<PlacePair> places_under(const Map& map) {
  std::vector<PlacePair> places;
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(1, 1), Eigen::Vector2d(9, 1.5), Eigen::Vector2d(8, 7),
        Eigen::Vector2d(2, 6), Eigen::Vector2d(5, 4), Eigen::Vector2d(5, 7.5),
        Eigen::Vector2d(6.5, 2.5), Eigen::Vector2d(2.5, 3.5)}) {
    places.push_back({point, map(point)});
  }
  return places;
}

TEST(CorrespondenceFit, FindsAnExactSimilarityAndKeepsIt) {
  const Sim2 sketch_from_world = Sim2::from_xy_yaw_scale(40, 200, 1.1, 20);
  const CorrespondenceFit fit = fit_correspondences(
      places_under([&](const Eigen::Vector2d& p) { return sketch_from_world * p; }), kLayout);
  ASSERT_EQ(fit.status, Status::Fitted);
  EXPECT_LT(fit.left_out_px, 1e-9);
  const Se2 world_from_robot = Se2::from_xy_yaw(3, 2, 0.4);
  EXPECT_THAT(fit.sketch_from_world.sketch_from_robot(world_from_robot),
              testing::IsNear(
                  Sim2::from_xy_yaw_scale((sketch_from_world * Eigen::Vector2d(3, 2)).x(),
                                          (sketch_from_world * Eigen::Vector2d(3, 2)).y(), 1.5, 20),
                  1e-6));
}

TEST(CorrespondenceFit, TakesAShearForAnAffineMap) {
  const CorrespondenceFit fit =
      fit_correspondences(places_under([](const Eigen::Vector2d& p) {
                            return Eigen::Vector2d(30 * p.x() + 4 * p.y() + 7, 15 * p.y() - 3);
                          }),
                          kLayout);
  ASSERT_EQ(fit.status, Status::Fitted);
  EXPECT_NE(fit.kind, Kind::Similarity);
  EXPECT_LT(fit.left_out_px, 1e-6);
}

TEST(CorrespondenceFit, BendsWhereThePlacesAreBentAndBendingHelps) {
  const CorrespondenceFit fit = fit_correspondences(
      places_under([](const Eigen::Vector2d& p) {
        return Eigen::Vector2d(20 * p.x() + 1.5 * (p.y() - 4) * (p.y() - 4), 20 * p.y());
      }),
      kLayout);
  ASSERT_EQ(fit.status, Status::Fitted);
  EXPECT_EQ(fit.kind, Kind::ThinPlateSpline);
  EXPECT_LT(fit.residual_px, fit.left_out_px);
}

TEST(CorrespondenceFit, MeasuresTheErrorThatWasWorkedOutByHand) {
  // Three places on a line, no other map than a similarity: the middle one is off by 3 px from the
  // line through the outer ones (2 m at 10 px/m each). Left out in turn, the outer ones are missed
  // by the rotated and scaled step from the other two.
  const std::vector<PlacePair> places = {{{0, 0}, {0, 0}}, {{2, 0}, {20, 3}}, {{4, 0}, {40, 0}}};
  const CorrespondenceFit fit = fit_correspondences(places, kLayout);
  ASSERT_EQ(fit.status, Status::Fitted);
  EXPECT_EQ(fit.kind, Kind::Similarity);
  // Without an end: extrapolation gives (40, 6) for (40, 0) and (0, 6) for (0, 0).
  EXPECT_NEAR(fit.left_out_px, std::sqrt((36.0 + 9.0 + 36.0) / 3.0), 1e-9);
  EXPECT_NEAR(fit.left_out_m, fit.left_out_px / 10.0, 1e-9);
}

TEST(CorrespondenceFit, IsNotFlatteredByPlacesThatAreThereTwice) {
  const auto bent = [](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(20 * p.x() + 3 * p.y() * p.y(), 20 * p.y());
  };
  const std::vector<PlacePair> once = places_under(bent);
  std::vector<PlacePair> twice = once;
  for (const PlacePair& place : once) {
    const Eigen::Vector2d near = place.point_in_world + Eigen::Vector2d(0.1, 0.0);
    twice.push_back({near, bent(near)});
  }
  const double once_px = fit_correspondences(once, kLayout).left_out_px;
  EXPECT_GT(fit_correspondences(twice, kLayout).left_out_px, 0.7 * once_px);
}

TEST(CorrespondenceFit, NeverFoldsTheLayout) {
  // Two places swapped: a soft spline would fold between them.
  std::vector<PlacePair> places =
      places_under([](const Eigen::Vector2d& p) { return Eigen::Vector2d(20 * p); });
  std::swap(places[4].point_in_sketch, places[6].point_in_sketch);
  const CorrespondenceFit fit = fit_correspondences(places, kLayout);
  ASSERT_EQ(fit.status, Status::Fitted);
  const auto at = [&](const Eigen::Vector2d& point) { return fit.sketch_from_world.at(point); };
  EXPECT_FALSE(find_folds(at, kLayout, 60).folds());
}

TEST(CorrespondenceFit, SaysThatPlacesAreTooFew) {
  EXPECT_EQ(fit_correspondences({}, kLayout).status, Status::TooFewPlaces);
  const std::vector<PlacePair> two = {{{1, 1}, {10, 10}}, {{5, 1}, {50, 10}}};
  EXPECT_EQ(fit_correspondences(two, kLayout).status, Status::TooFewPlaces);
  const std::vector<PlacePair> one_thrice = {
      {{1, 1}, {10, 10}}, {{1, 1.1}, {10, 11}}, {{1.1, 1}, {11, 10}}};
  EXPECT_EQ(fit_correspondences(one_thrice, kLayout).status, Status::TooFewPlaces);
}

TEST(CorrespondenceFit, ScoresOnlyInsideTheHullOfThePlaces) {
  const std::vector<PlacePair> places = {
      {{0, 0}, {0, 0}}, {{4, 0}, {40, 0}}, {{0, 4}, {0, 40}}, {{1, 1}, {10, 12}}};
  const CorrespondenceFit fit = fit_correspondences(places, kLayout);
  ASSERT_EQ(fit.status, Status::Fitted);
  EXPECT_EQ(fit.hull_in_world.size(), 3U);
  const MetricTrajectory world_from_robot({{0.0, Se2::from_xy_yaw(1, 1, 0)},
                                           {1.0, Se2::from_xy_yaw(3, 3, 0)},
                                           {2.0, Se2::from_xy_yaw(0.5, 0.5, 0)}});
  const ReferencePose pose{.sketch_from_robot = Sim2::from_xy_yaw_scale(10, 10, 0, 10)};
  Reference reference{.poses = {pose, pose, pose}};
  reference.poses[2].scored = false;  // outside the drawing
  const Reference supported = with_support(reference, fit, world_from_robot);
  EXPECT_TRUE(supported.poses[0].scored);
  EXPECT_FALSE(supported.poses[1].scored);
  EXPECT_FALSE(supported.poses[2].scored);
  EXPECT_DOUBLE_EQ(supported.poses[0].uncertainty_m, fit.left_out_px / 10.0);
}

TEST(CorrespondenceFit, ScoresNothingWhereThePlacesLieOnOneLine) {
  const std::vector<PlacePair> places = {{{0, 0}, {0, 0}}, {{2, 0}, {20, 1}}, {{4, 0}, {40, 0}}};
  const CorrespondenceFit fit = fit_correspondences(places, kLayout);
  const MetricTrajectory world_from_robot({{0.0, Se2::from_xy_yaw(2, 0, 0)}});
  EXPECT_FALSE(with_support({.poses = {ReferencePose{}}}, fit, world_from_robot).poses[0].scored);
}

}  // namespace
}  // namespace sketchloc

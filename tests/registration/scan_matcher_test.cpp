#include "registration/scan_matcher.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "registration/detail/point_to_line.hpp"
#include "registration/pose_search.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/numeric_jacobian.hpp"
#include "tests/support/segment_world.hpp"

namespace sketchloc {
namespace {

using testing::endless_corridor;
using testing::furnished_room;
using testing::IsNear;
using testing::scan_from;
using testing::World;

constexpr double kRadius_m = 0.3;

std::vector<SurfacePoint> points_at(const World& world, const Se2& world_from_robot,
                                    double noise_m = 0.0) {
  Rng rng = make_rng(7);
  return surface_points_in_robot(scan_from(world, world_from_robot, noise_m, rng));
}

SurfaceMap map_of(const std::vector<SurfacePoint>& points) {
  SurfaceMap map(kRadius_m);
  map.refill(points);
  return map;
}

PosePrior weak_prior(const Se2& odom_from_robot) {
  return {odom_from_robot, 1e-3 * Eigen::Matrix3d::Identity()};
}

TEST(PointToLine, HasTheGradientOfItsCost) {
  const SurfaceMap map = map_of(points_at(furnished_room(), Se2()));
  const std::vector<SurfacePoint> points = points_at(furnished_room(), Se2(), 0.02);
  const Se2 odom_from_robot = Se2::from_xy_yaw(0.03, -0.02, 0.01);
  const auto cost_after = [&](const Eigen::Vector3d& step) {
    const Se2 moved = odom_from_robot * Se2::exp(step);
    const double cost = detail::linearize_point_to_line(points, map, moved, 0.1).cost;
    return Eigen::Matrix<double, 1, 1>(cost);
  };
  const detail::PointToLine terms =
      detail::linearize_point_to_line(points, map, odom_from_robot, 0.1);
  // So small a step that no point changes its partner.
  const Eigen::RowVector3d numeric =
      testing::numeric_jacobian(cost_after, Eigen::Vector3d(Eigen::Vector3d::Zero()), 1e-8);
  EXPECT_GT(terms.half_gradient.norm(), 0.1);
  EXPECT_TRUE((2.0 * terms.half_gradient.transpose()).isApprox(numeric, 1e-4))
      << 2.0 * terms.half_gradient.transpose() << " but numerically " << numeric;
}

TEST(ScanMatcher, FindsASmallMotionExactly) {
  const Se2 motion = Se2::from_xy_yaw(0.06, -0.04, 0.03);
  const SurfaceMap map = map_of(points_at(furnished_room(), Se2()));
  const ScanMatch match =
      match_scan(points_at(furnished_room(), motion), map, weak_prior(Se2()), Se2());
  EXPECT_EQ(match.status, ScanMatch::Status::Converged);
  EXPECT_GT(match.matched_share, 0.9);
  EXPECT_THAT(match.odom_from_robot, IsNear(motion, 0.003));
}

TEST(ScanMatcher, KnowsNothingAlongACorridor) {
  const std::vector<SurfacePoint> points = points_at(endless_corridor(), Se2());
  const ScanMatch match = match_scan(points, map_of(points), weak_prior(Se2()), Se2());
  EXPECT_LT(match.scan_information(0, 0), 1e-3 * match.scan_information(1, 1));
}

TEST(ScanMatcher, HoldsToThePriorWhereTheScanKnowsNothing) {
  const std::vector<SurfacePoint> points = points_at(endless_corridor(), Se2());
  const Se2 expected = Se2::from_xy_yaw(0.2, 0.0, 0.0);
  const ScanMatch match =
      match_scan(points, map_of(points), weak_prior(expected), Se2::from_xy_yaw(0.1, 0.05, 0.0));
  EXPECT_EQ(match.status, ScanMatch::Status::Converged);
  EXPECT_THAT(match.odom_from_robot, IsNear(expected, 0.01));
}

TEST(ScanMatcher, SaysSoIfThereIsTooLittleToMatch) {
  const std::vector<SurfacePoint> points = points_at(furnished_room(), Se2());
  const Se2 start = Se2::from_xy_yaw(1.0, 2.0, 0.5);
  const ScanMatch nothing = match_scan({}, map_of(points), weak_prior(start), start);
  EXPECT_EQ(nothing.status, ScanMatch::Status::TooFewPoints);
  EXPECT_THAT(nothing.odom_from_robot, IsNear(start, 0.0));
  const ScanMatch nowhere = match_scan(points, map_of({}), weak_prior(start), start);
  EXPECT_EQ(nowhere.status, ScanMatch::Status::TooFewPoints);
}

TEST(ScanMatcher, RefusesParametersOutOfRange) {
  EXPECT_THROW(validate(ScanMatchParams{.kernel_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(ScanMatchParams{.independent_share = 1.5}), std::invalid_argument);
  EXPECT_NO_THROW(validate(ScanMatchParams{}));
}

TEST(PoseSearch, FindsALargeMotionToWithinItsSteps) {
  const Se2 motion = Se2::from_xy_yaw(0.5, -0.3, 0.45);
  SurfaceGrid grid;
  grid.refill(points_at(furnished_room(), Se2()));
  PoseSearch search;
  const std::vector<PoseCandidate> candidates = search.search(
      points_at(furnished_room(), motion), grid, Se2(), Eigen::Vector3d(0.2, 0.2, 0.2));
  ASSERT_FALSE(candidates.empty());
  EXPECT_THAT(candidates.front().odom_from_robot, IsNear(motion, 0.1));
}

TEST(PoseSearch, GivesDistinctCandidatesBestFirst) {
  const PoseSearchParams params;
  SurfaceGrid grid(params);
  const std::vector<SurfacePoint> points = points_at(furnished_room(), Se2());
  grid.refill(points);
  PoseSearch search(params);
  const std::vector<PoseCandidate> candidates =
      search.search(points, grid, Se2(), Eigen::Vector3d(0.2, 0.2, 0.2));
  ASSERT_GT(candidates.size(), 1U);
  EXPECT_LE(candidates.size(), static_cast<std::size_t>(params.max_candidates));
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    EXPECT_LE(candidates[i].score, candidates[i - 1].score);
    const Se2 apart = candidates[0].odom_from_robot.inverse() * candidates[i].odom_from_robot;
    EXPECT_TRUE(apart.translation().norm() >= params.candidate_gap_m ||
                std::abs(apart.yaw_rad()) >= params.candidate_gap_rad);
  }
}

TEST(PoseSearch, FindsNothingWithoutSurfacesOrPoints) {
  const Eigen::Vector3d sigma(0.1, 0.1, 0.1);
  const std::vector<SurfacePoint> points = points_at(furnished_room(), Se2());
  SurfaceGrid grid;
  PoseSearch search;
  EXPECT_TRUE(search.search(points, grid, Se2(), sigma).empty());
  grid.refill(points);
  EXPECT_TRUE(search.search({}, grid, Se2(), sigma).empty());
  const Se2 far_away = Se2::from_xy_yaw(1e6, -1e6, 0.0);
  EXPECT_LE(search.search(points, grid, far_away, sigma).front().score, 0.0);
}

TEST(PoseSearch, RefusesParametersOutOfRange) {
  EXPECT_THROW(PoseSearch(PoseSearchParams{.cell_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(SurfaceGrid(PoseSearchParams{.min_shift_m = 2.0, .max_shift_m = 1.0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

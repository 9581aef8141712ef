#include "registration/surface_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "motion/random.hpp"
#include "registration/surface_merge.hpp"

namespace sketchloc {
namespace {

constexpr double kRadius_m = 0.5;

std::vector<SurfacePoint> random_points(std::size_t count, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle_rad = uniform(-std::numbers::pi, std::numbers::pi, rng);
    const Eigen::Vector2d point(uniform(-5.0, 5.0, rng), uniform(-3.0, 3.0, rng));
    points.push_back({point, {std::cos(angle_rad), std::sin(angle_rad)}});
  }
  return points;
}

/// The obvious way: distance of the nearest agreeing point, infinity if none is near.
double nearest_distance(std::span<const SurfacePoint> points, const SurfacePoint& query) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const SurfacePoint& surface : points) {
    const double distance_m = (surface.point - query.point).norm();
    if (surface.normal.dot(query.normal) > 0.7 && distance_m < kRadius_m) {
      nearest_m = std::min(nearest_m, distance_m);
    }
  }
  return nearest_m;
}

TEST(SurfaceMap, FindsTheSameNeighbourAsTheObviousSearch) {
  const std::vector<SurfacePoint> points = random_points(400, 1);
  SurfaceMap map(kRadius_m);
  map.refill(points);
  int found = 0;
  for (SurfacePoint query : random_points(400, 2)) {
    query.point *= 1.3;  // some outside
    const double expected_m = nearest_distance(points, query);
    const SurfacePoint* nearest = map.nearest(query);
    ASSERT_EQ(nearest != nullptr, std::isfinite(expected_m));
    if (nearest != nullptr) {
      EXPECT_DOUBLE_EQ((nearest->point - query.point).norm(), expected_m);
      ++found;
    }
  }
  EXPECT_GT(found, 100);
}

TEST(SurfaceMap, ForgetsItsPointsWhenRefilled) {
  SurfaceMap map(kRadius_m);
  const SurfacePoint point{{1.0, 2.0}, {1.0, 0.0}};
  EXPECT_EQ(map.nearest(point), nullptr);
  map.refill(std::vector<SurfacePoint>{point});
  ASSERT_NE(map.nearest(point), nullptr);
  map.refill({});
  EXPECT_EQ(map.nearest(point), nullptr);
  EXPECT_EQ(map.size(), 0U);
}

TEST(SurfaceMap, FindsNothingForAPointThatIsNotANumber) {
  SurfaceMap map(kRadius_m);
  map.refill(random_points(10, 3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(map.nearest({{nan, 0.0}, {1.0, 0.0}}), nullptr);
}

TEST(SurfaceMerger, AveragesThePointsOfOneCellAndDirection) {
  SurfaceMerger merger(1.0);
  const std::vector<SurfacePoint> points = {
      {{0.2, 0.5}, {1.0, 0.0}}, {{0.4, 0.9}, {0.8, 0.6}}, {{-0.2, 0.5}, {1.0, 0.0}}};
  const std::span<const SurfacePoint> merged = merger.merge(points);
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_TRUE(merged[0].point.isApprox(Eigen::Vector2d(0.3, 0.7), 1e-12));
  EXPECT_TRUE(merged[0].normal.isApprox(Eigen::Vector2d(1.8, 0.6).normalized(), 1e-12));
  EXPECT_TRUE(merged[1].point.isApprox(points[2].point, 1e-12));
}

TEST(SurfaceMerger, KeepsTheTwoFacesOfAThinWallApart) {
  SurfaceMerger merger(1.0);
  const std::vector<SurfacePoint> points = {{{0.4, 0.5}, {1.0, 0.0}}, {{0.5, 0.5}, {-1.0, 0.0}}};
  EXPECT_EQ(merger.merge(points).size(), 2U);
  EXPECT_TRUE(merger.merge({}).empty());
}

TEST(SurfaceMerger, GivesEveryPointBackWhereCellsAreTiny) {
  SurfaceMerger merger(1e-6);
  const std::vector<SurfacePoint> points = random_points(1000, 4);
  const std::span<const SurfacePoint> merged = merger.merge(points);
  ASSERT_EQ(merged.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(merged[i].point.isApprox(points[i].point, 1e-12));
  }
}

}  // namespace
}  // namespace sketchloc

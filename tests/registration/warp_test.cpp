#include "registration/warp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/random.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

const Sim2 kSketchFromRobot = Sim2::from_xy_yaw_scale(310.0, 140.0, 2.1, 18.0);

/// 4x4 points over 12 m around the robot.
std::vector<Eigen::Vector2d> lattice_in_robot() {
  std::vector<Eigen::Vector2d> points;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      points.emplace_back(-6.0 + 4.0 * column, -6.0 + 4.0 * row);
    }
  }
  return points;
}

/// A similarity, and on top of it a shift of every place by up to `bend_px`.
std::vector<Eigen::Vector2d> bent(std::span<const Eigen::Vector2d> points_in_robot,
                                  double bend_px) {
  Rng rng = make_rng(5);
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : points_in_robot) {
    places.push_back(kSketchFromRobot * point + Eigen::Vector2d(uniform(-bend_px, bend_px, rng),
                                                                uniform(-bend_px, bend_px, rng)));
  }
  return places;
}

class WarpOf : public ::testing::TestWithParam<bool> {
 protected:
  /// The same places and points, the spline made either way.
  std::optional<Warp> warp(double bend_px) const {
    const std::vector<Eigen::Vector2d> points = lattice_in_robot();
    const std::vector<Eigen::Vector2d> places = bent(points, bend_px);
    return GetParam() ? Warp::from_robot_points(points, places)
                      : Warp::from_sketch_places(places, points);
  }
};

TEST_P(WarpOf, MeetsItsControlPoints) {
  const std::vector<Eigen::Vector2d> points = lattice_in_robot();
  const std::vector<Eigen::Vector2d> places = bent(points, 15.0);
  const std::optional<Warp> bending = warp(15.0);
  ASSERT_TRUE(bending);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<PlaneMapPoint> image = bending->sketch_from_robot(points[i]);
    ASSERT_TRUE(image);
    EXPECT_LT((image->value - places[i]).norm(), 1e-4);
  }
}

TEST_P(WarpOf, GoesBothWays) {
  const std::optional<Warp> bending = warp(15.0);
  for (const Eigen::Vector2d& point : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(3.1, -4.7)}) {
    const std::optional<PlaneMapPoint> image = bending->sketch_from_robot(point);
    ASSERT_TRUE(image);
    const std::optional<Eigen::Vector2d> back = bending->robot_from_sketch(image->value);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - point).norm(), 1e-5);
  }
}

TEST_P(WarpOf, HasTheJacobianOfItsValues) {
  const std::optional<Warp> bending = warp(15.0);
  const Eigen::Vector2d point(1.3, 0.4);
  constexpr double kStep = 1e-4;
  const std::optional<PlaneMapPoint> image = bending->sketch_from_robot(point);
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
    const Eigen::Vector2d slope = (bending->sketch_from_robot(point + step)->value -
                                   bending->sketch_from_robot(point - step)->value) /
                                  (2.0 * kStep);
    EXPECT_LT((slope - image->jacobian.col(axis)).norm(), 0.02);
  }
}

TEST_P(WarpOf, IsTheSimilarityWhereNothingBends) {
  const std::optional<Sim2> pose = warp(0.0)->pose();
  ASSERT_TRUE(pose);
  EXPECT_THAT(*pose, IsNear(kSketchFromRobot, 1e-5));
}

TEST_P(WarpOf, FindsItsFolds) {
  const PlaneBox box{.low = {-6.0, -6.0}, .high = {6.0, 6.0}};
  EXPECT_FALSE(warp(5.0)->find_folds(box, 9).folds());
  EXPECT_TRUE(warp(200.0)->find_folds(box, 9).folds());
}

INSTANTIATE_TEST_SUITE_P(Directions, WarpOf, ::testing::Bool(), [](const auto& instance) {
  return instance.param ? "RobotPoints" : "SketchPlaces";
});

TEST(Warp, HasNoPoseWhereItIsAMirror) {
  std::vector<Eigen::Vector2d> points = lattice_in_robot();
  std::vector<Eigen::Vector2d> mirrored = points;
  for (Eigen::Vector2d& point : mirrored) {
    point.y() = -point.y();
  }
  EXPECT_FALSE(Warp::from_robot_points(points, mirrored)->pose());
}

TEST(Warp, IsNotDefinedByPointsOnALine) {
  const std::vector<Eigen::Vector2d> line = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  EXPECT_FALSE(Warp::from_robot_points(line, line));
  EXPECT_FALSE(Warp::from_sketch_places(line, line));
}

TEST(Warp, TakesAStrainApartAsItsPolarDecomposition) {
  const Eigen::Matrix2d stretch = Eigen::Vector2d(20.0, 5.0).asDiagonal();
  const Sim2 turn = Sim2::from_xy_yaw_scale(0.0, 0.0, 0.6, 1.0);
  std::vector<Eigen::Vector2d> points = lattice_in_robot();
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : points) {
    places.push_back(stretch * (turn * point));
  }
  const std::optional<Sim2> pose = Warp::from_robot_points(points, places)->pose();
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->yaw_rad(), 0.6, 1e-9);
  EXPECT_NEAR(pose->scale(), 10.0, 1e-9);
}

}  // namespace
}  // namespace sketchloc

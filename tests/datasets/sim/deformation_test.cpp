#include "datasets/sim/deformation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "motion/random.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/numeric_jacobian.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

ThinPlateSpline bend() {
  const std::vector<Eigen::Vector2d> points = {{0, 0}, {20, 0}, {0, 20}, {20, 20}, {10, 10}};
  std::vector<Eigen::Vector2d> values = points;
  values.back() += Eigen::Vector2d(2.0, -1.0);
  return TpsSolver::factor(points)->solve(values);
}

/// One of each kind of map.
Deformation mixed() {
  Deformation deformation;
  Grid<double> rates(5, 3, 1.0);
  rates.at({2, 1}) = 2.5;
  deformation.then(AxisStretch({.axis = 1, .along = 4.0, .across = 5.0}, rates, {0.0, 1.0, -1.0}));
  deformation.then(bend());
  deformation.then(AffineMap{.linear = (Eigen::Matrix2d() << 3.0, -15.0, 18.0, 2.0).finished(),
                             .shift = {100.0, 50.0}});
  return deformation;
}

TEST(Deformation, HasTheJacobianOfItsValue) {
  const Deformation deformation = mixed();
  for (double x = 0.3; x < 20.0; x += 3.1) {
    for (double y = 0.7; y < 20.0; y += 3.3) {
      const Eigen::Vector2d point(x, y);
      EXPECT_TRUE(deformation.at(point).jacobian.isApprox(
          testing::numeric_jacobian(deformation, point), 1e-5));
    }
  }
}

TEST(Deformation, IsTheIdentityWithoutSteps) {
  const Deformation none;
  EXPECT_EQ(none({3.0, 4.0}), Eigen::Vector2d(3.0, 4.0));
}

TEST(Deformation, MovesPosesLikeASimilarityWhereItIsOne) {
  const Sim2 sketch_from_world = Sim2::from_xy_yaw_scale(40.0, -5.0, 2.0, 18.0);
  Deformation deformation;
  deformation.then(AffineMap{.linear = sketch_from_world.scaled_rotation_matrix(),
                             .shift = sketch_from_world.translation()});
  const Se2 world_from_robot = Se2::from_xy_yaw(3.0, 1.0, -2.5);
  EXPECT_THAT(deformation.sketch_from_robot(world_from_robot),
              IsNear(sketch_from_world * world_from_robot, 1e-9));
}

TEST(Deformation, InverseFindsThePlaceThatWasDrawn) {
  const Deformation deformation = mixed();
  const Eigen::Vector2d place(7.0, 13.0);
  const Inversion inversion = invert(deformation, deformation(place), {10.0, 10.0});
  EXPECT_EQ(inversion.status, Inversion::Status::Converged);
  EXPECT_LT((inversion.point - place).norm(), 1e-6);
}

TEST(LocalSimilarity, IsThePolarRotationAndTheRatioOfTheSingularValues) {
  Rng rng = make_rng(1);
  for (int i = 0; i < 50; ++i) {
    Eigen::Matrix2d jacobian;
    do {
      jacobian << uniform(-1, 1, rng), uniform(-1, 1, rng), uniform(-1, 1, rng),
          uniform(-1, 1, rng);
    } while (jacobian.determinant() < 0.01);
    const Eigen::JacobiSVD<Eigen::Matrix2d> svd(jacobian,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix2d rotation = svd.matrixU() * svd.matrixV().transpose();
    const LocalSimilarity local = local_similarity(jacobian);
    EXPECT_NEAR(local.rotation_rad, std::atan2(rotation(1, 0), rotation(0, 0)), 1e-9);
    EXPECT_NEAR(local.scale, std::sqrt(svd.singularValues().prod()), 1e-9);
    EXPECT_NEAR(local.anisotropy / (svd.singularValues()(0) / svd.singularValues()(1)), 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace sketchloc

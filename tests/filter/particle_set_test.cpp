#include "filter/particle_set.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

TEST(ParticleSet, GivesTheSimilarityPartOfAParticle) {
  ParticleSet particles;
  particles.resize(2);
  particles.x_px[1] = 3.0F;
  particles.y_px[1] = -4.0F;
  particles.heading_rad[1] = 0.5F;
  particles.log_scale[1] = std::log(20.0F);
  EXPECT_THAT(particles.sketch_from_robot(1),
              IsNear(Sim2::from_xy_yaw_scale(3.0, -4.0, 0.5, 20.0), 1e-5));
}

TEST(ParticleSet, AssignCopiesEveryField) {
  ParticleSet from;
  from.resize(1);
  float value = 1.0F;
  for (std::vector<float>* field :
       {&from.x_px, &from.y_px, &from.heading_rad, &from.log_scale, &from.log_mean_scale,
        &from.axial_strain, &from.diagonal_strain, &from.log_weight}) {
    (*field)[0] = value++;
  }
  ParticleSet to;
  to.resize(2);
  to.assign(1, from, 0);
  EXPECT_EQ(to.x_px[1], 1.0F);
  EXPECT_EQ(to.diagonal_strain[1], 7.0F);
  EXPECT_EQ(to.log_weight[1], 8.0F);
  EXPECT_EQ(to.x_px[0], 0.0F);
}

TEST(StrainMatrix, HasUnitAreaAndTheStatedRatioOfSingularValues) {
  for (const double axial : {0.0, 1e-9, 0.3, -0.7}) {
    const Eigen::Matrix2d strain = strain_matrix(axial, 0.2);
    EXPECT_NEAR(strain.determinant(), 1.0, 1e-12);
    const Eigen::Vector2d singular = strain.jacobiSvd().singularValues();
    EXPECT_NEAR(singular[0] / singular[1], std::exp(2.0 * std::hypot(axial, 0.2)), 1e-9);
  }
}

TEST(StrainMatrix, StretchesAlongItsAxis) {
  EXPECT_TRUE(strain_matrix(std::log(2.0), 0.0)
                  .isApprox(Eigen::Vector2d(2.0, 0.5).asDiagonal().toDenseMatrix(), 1e-12));
  const Eigen::Vector2d diagonal(1.0, 1.0);
  EXPECT_TRUE((strain_matrix(0.0, std::log(2.0)) * diagonal).isApprox(2.0 * diagonal, 1e-12));
}

}  // namespace
}  // namespace sketchloc

#include "filter/predict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/matchers.hpp"
#include "tests/support/moments.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

ParticleSet particles_at(std::size_t count, float heading_rad, float log_scale) {
  ParticleSet particles;
  particles.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    particles.heading_rad[i] = heading_rad;
    particles.log_scale[i] = log_scale;
    particles.log_mean_scale[i] = log_scale;
  }
  return particles;
}

PredictParams noise_free() {
  PredictParams params = metric_motion();
  params.odometry = {
      .slip_m_per_m = 0.0, .slip_m_per_rad = 0.0, .turn_rad_per_m = 0.0, .turn_rad_per_rad = 0.0};
  return params;
}

TEST(Predict, WithoutMotionChangesAndDrawsNothing) {
  ParticleSet particles = particles_at(3, 0.3F, 2.0F);
  Rng rng = make_rng(1);
  Rng untouched = make_rng(1);
  predict(particles, {0, 3}, Se2(), {}, rng);
  EXPECT_EQ(particles.x_px[1], 0.0F);
  EXPECT_EQ(particles.log_scale[2], 2.0F);
  EXPECT_EQ(rng(), untouched());
}

TEST(Predict, WithoutNoiseComposesInSim2) {
  ParticleSet particles = particles_at(2, 0.7F, std::log(20.0F));
  const Sim2 before = particles.sketch_from_robot(1);
  const Se2 robot_from_next = Se2::from_xy_yaw(0.5, -0.1, 0.4);
  Rng rng = make_rng(1);
  predict(particles, {0, 2}, robot_from_next, noise_free(), rng);
  EXPECT_THAT(particles.sketch_from_robot(1), IsNear(before * robot_from_next, 1e-5));
}

TEST(Predict, MovesByTheStrainedMap) {
  ParticleSet particles = particles_at(1, 0.7F, std::log(20.0F));
  particles.axial_strain[0] = 0.3F;
  particles.diagonal_strain[0] = -0.2F;
  PredictParams params = noise_free();
  params.deformation.strain_memory_m = 1e9;
  const Eigen::Vector2d step_m(0.5, 0.2);
  Rng rng = make_rng(1);
  predict(particles, {0, 1}, Se2::from_xy_yaw(step_m.x(), step_m.y(), 0.0), params, rng);
  const Eigen::Vector2d expected_px =
      20.0 * strain_matrix(0.3, -0.2) * (Se2::from_xy_yaw(0, 0, 0.7).rotation_matrix() * step_m);
  EXPECT_NEAR(particles.x_px[0], expected_px.x(), 1e-4);
  EXPECT_NEAR(particles.y_px[0], expected_px.y(), 1e-4);
}

TEST(Predict, LocalScaleAndStrainReturnToTheirMeans) {
  ParticleSet particles = particles_at(1, 0.0F, 3.0F);
  particles.log_scale[0] = 4.0F;
  particles.axial_strain[0] = 1.0F;
  PredictParams params = noise_free();
  params.deformation.scale_memory_m = 2.0;
  params.deformation.strain_memory_m = 1.0;
  Rng rng = make_rng(1);
  predict(particles, {0, 1}, Se2::from_xy_yaw(2.0, 0.0, 0.0), params, rng);
  EXPECT_NEAR(particles.log_scale[0], 3.0 + std::exp(-1.0), 1e-5);
  EXPECT_NEAR(particles.axial_strain[0], std::exp(-2.0), 1e-5);
}

TEST(Predict, LeavesParticlesOutsideTheRangeAlone) {
  ParticleSet particles = particles_at(3, 0.0F, 3.0F);
  Rng rng = make_rng(1);
  predict(particles, {1, 2}, Se2::from_xy_yaw(1.0, 0.0, 0.0), {}, rng);
  EXPECT_EQ(particles.x_px[0], 0.0F);
  EXPECT_NE(particles.x_px[1], 0.0F);
  EXPECT_EQ(particles.x_px[2], 0.0F);
}

TEST(PredictStatistical, SpreadsAsItsParametersSay) {
  constexpr std::size_t kCount = 20000;
  ParticleSet particles = particles_at(kCount, 0.0F, std::log(10.0F));
  PredictParams params = noise_free();
  params.deformation = {.length_m = 0.4,
                        .shear_m = 0.2,
                        .heading_rad = 0.05,
                        .log_scale = 0.1,
                        .scale_memory_m = 1e9,
                        .log_mean_scale = 0.03,
                        .strain = 0.15,
                        .strain_memory_m = 1e9};
  const double way_m = 0.25;
  Rng rng = make_rng(7);
  predict(particles, {0, kCount}, Se2::from_xy_yaw(way_m, 0.0, 0.0), params, rng);
  const auto expect_spread = [](const std::vector<float>& values, double mean, double sigma) {
    const std::vector<double> sample(values.begin(), values.end());
    const testing::SampleMoments m = testing::sample_moments(sample);
    EXPECT_NEAR(m.mean, mean, 5.0 * m.mean_error);
    EXPECT_NEAR(m.variance, sigma * sigma, 5.0 * m.variance_error);
  };
  expect_spread(particles.x_px, 10.0 * way_m, 10.0 * 0.4 * std::sqrt(way_m));
  expect_spread(particles.y_px, 0.0, 10.0 * 0.2 * std::sqrt(way_m));
  expect_spread(particles.heading_rad, 0.0, 0.05 * std::sqrt(way_m));
  expect_spread(particles.log_scale, std::log(10.0), 0.1 * std::sqrt(way_m));
  expect_spread(particles.log_mean_scale, std::log(10.0), 0.03 * std::sqrt(way_m));
  expect_spread(particles.diagonal_strain, 0.0, 0.15 * std::sqrt(way_m));
}

TEST(PredictStatistical, SpreadsAlikeInOneStepOrInMany) {
  constexpr std::size_t kCount = 20000;
  PredictParams params = noise_free();
  params.deformation.shear_m = 0.2;
  const auto spread_after = [&](int steps) {
    ParticleSet particles = particles_at(kCount, 0.0F, 0.0F);
    Rng rng = make_rng(7);
    for (int step = 0; step < steps; ++step) {
      predict(particles, {0, kCount}, Se2::from_xy_yaw(0.4 / steps, 0.0, 0.0), params, rng);
    }
    return testing::sample_moments(
        std::vector<double>(particles.y_px.begin(), particles.y_px.end()));
  };
  const testing::SampleMoments once = spread_after(1);
  const testing::SampleMoments often = spread_after(20);
  EXPECT_NEAR(once.variance, often.variance,
              5.0 * std::hypot(once.variance_error, often.variance_error));
}

TEST(PredictParams, RefuseWhatIsOutOfRange) {
  PredictParams params;
  params.deformation.scale_memory_m = 0.0;
  EXPECT_THROW(validate(params), std::invalid_argument);
  params = {};
  params.deformation.strain = std::nan("");
  EXPECT_THROW(validate(params), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

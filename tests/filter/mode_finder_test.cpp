#include "filter/mode_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "filter/resample.hpp"
#include "motion/angles.hpp"
#include "motion/random.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

constexpr double kSigmaPx = 4.0;
constexpr double kSigmaRad = 0.05;

/// Adds particles around a pose with scale 20 px/m, all of weight one.
void add_cluster(ParticleSet& particles, const Sim2& pose, std::size_t count, Rng& rng) {
  const std::size_t begin = particles.size();
  particles.resize(begin + count);
  for (std::size_t i = begin; i < particles.size(); ++i) {
    particles.x_px[i] = static_cast<float>(pose.x() + gaussian(kSigmaPx, rng));
    particles.y_px[i] = static_cast<float>(pose.y() + gaussian(kSigmaPx, rng));
    particles.heading_rad[i] =
        static_cast<float>(wrap_rad(pose.yaw_rad() + gaussian(kSigmaRad, rng)));
    particles.log_scale[i] = static_cast<float>(std::log(pose.scale()));
    particles.log_weight[i] = 0.0F;
  }
}

TEST(ModeFinder, FindsOneModePerCluster) {
  const Sim2 left = Sim2::from_xy_yaw_scale(100.0, 100.0, 0.0, 20.0);
  const Sim2 right = Sim2::from_xy_yaw_scale(400.0, 100.0, 1.0, 20.0);
  Rng rng = make_rng(5);
  ParticleSet particles;
  add_cluster(particles, left, 300, rng);
  add_cluster(particles, right, 700, rng);
  normalise(particles);
  ModeFinder finder({}, particles.size());
  Estimate estimate;
  finder.find(particles, estimate);
  ASSERT_EQ(estimate.modes.size(), 2U);
  EXPECT_NEAR(estimate.modes[0].weight, 0.7, 1e-6);
  EXPECT_NEAR(estimate.modes[1].weight, 0.3, 1e-6);
  EXPECT_THAT(estimate.sketch_from_robot, IsNear(right, 1.0));
  EXPECT_THAT(estimate.modes[1].sketch_from_robot, IsNear(left, 1.5));
}

TEST(ModeFinder, AveragesHeadingsAcrossPi) {
  const Sim2 pose = Sim2::from_xy_yaw_scale(100.0, 100.0, std::numbers::pi, 20.0);
  Rng rng = make_rng(6);
  ParticleSet particles;
  add_cluster(particles, pose, 1000, rng);
  normalise(particles);
  ModeFinder finder({}, particles.size());
  Estimate estimate;
  finder.find(particles, estimate);
  const double turn_rad = wrap_rad(estimate.sketch_from_robot.yaw_rad() - std::numbers::pi);
  EXPECT_NEAR(turn_rad, 0.0, 5.0 * kSigmaRad / std::sqrt(1000.0));
}

TEST(ModeFinderStatistical, GivesTheCovarianceOfTheCluster) {
  constexpr std::size_t kCount = 5000;
  Rng rng = make_rng(7);
  ParticleSet particles;
  add_cluster(particles, Sim2::from_xy_yaw_scale(100.0, 100.0, 0.5, 20.0), kCount, rng);
  normalise(particles);
  ModeFinder finder({}, kCount);
  Estimate estimate;
  finder.find(particles, estimate);
  const double relative = 5.0 * std::sqrt(2.0 / kCount);
  const double variance_px = kSigmaPx * kSigmaPx;
  EXPECT_NEAR(estimate.covariance(0, 0), variance_px, relative * variance_px);
  EXPECT_NEAR(estimate.covariance(1, 1), variance_px, relative * variance_px);
  EXPECT_NEAR(estimate.covariance(2, 2), kSigmaRad * kSigmaRad, relative * kSigmaRad * kSigmaRad);
  EXPECT_NEAR(estimate.covariance(0, 1), 0.0, 5.0 * variance_px / std::sqrt(kCount));
}

TEST(ModeFinder, ReportsOneParticleAsAModeWithoutSpread) {
  ParticleSet particles;
  particles.resize(1);
  particles.log_scale[0] = std::log(20.0F);
  ModeFinder finder({}, 1);
  Estimate estimate;
  finder.find(particles, estimate);
  ASSERT_EQ(estimate.modes.size(), 1U);
  EXPECT_NEAR(estimate.covariance.norm(), 0.0, 1e-9);
}

TEST(ModeParams, RefuseWhatIsOutOfRange) {
  EXPECT_THROW(validate(ModeParams{.radius_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(ModeParams{.max_modes = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc

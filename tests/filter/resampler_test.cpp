#include "filter/resampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sketchloc {
namespace {

/// Particles at x = 0, 1, ... px, equally heavy.
ParticleSet row_of(std::size_t count) {
  ParticleSet particles;
  particles.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    particles.x_px[i] = static_cast<float>(i);
    particles.log_weight[i] = 0.0F;
  }
  return particles;
}

TEST(Resampler, DrawsByWeightAndLeavesEqualWeights) {
  ParticleSet particles = row_of(4);
  particles.log_weight = {std::log(2.0F), std::log(2.0F), -100.0F, -100.0F};
  Resampler resampler({.min_particles = 1, .max_particles = 8});
  Rng rng = make_rng(1);
  resampler.draw(particles, 8, rng);
  EXPECT_EQ(particles.x_px, (std::vector<float>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(particles.log_weight, std::vector<float>(8, 0.0F));
}

TEST(Resampler, TakesAsManyAsTheBoundAsksForAndNoMoreThanItMay) {
  const KldParams params{.bin_m = 1.0, .min_particles = 10, .max_particles = 1000};
  Resampler resampler(params);
  ParticleSet together = row_of(500);
  std::fill(together.x_px.begin(), together.x_px.end(), 3.0F);
  Rng rng = make_rng(2);
  EXPECT_EQ(resampler.adapt(together, 1000, 1.0, rng), params.min_particles);
  EXPECT_EQ(together.size(), params.min_particles);

  ParticleSet apart = row_of(500);  // a bin each
  EXPECT_EQ(resampler.adapt(apart, 50, 1.0, rng), kld_count(50, params));
  EXPECT_EQ(apart.size(), 50U);
}

TEST(Resampler, HasBinsOfMetres) {
  const KldParams params{.bin_m = 1.0, .min_particles = 1, .max_particles = 2000};
  Resampler resampler(params);
  Rng rng = make_rng(3);
  ParticleSet particles = row_of(1000);
  EXPECT_EQ(resampler.adapt(particles, 2000, 250.0, rng), kld_count(4, params));
}

TEST(ReplaceEvenly, PutsOthersWithAWeightOfOneAllOverTheSet) {
  ParticleSet particles = row_of(90);
  std::fill(particles.log_weight.begin(), particles.log_weight.end(), -1.0F);
  ParticleSet others = row_of(2);
  others.x_px = {-1.0F, -2.0F};
  const std::array<std::uint32_t, 3> which = {1, 0, 1};
  Rng rng = make_rng(4);
  replace_evenly(particles, others, which, rng);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.x_px[i] < 0.0F) {
      EXPECT_EQ(particles.log_weight[i], 0.0F);
      places.push_back(i);
    }
  }
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(places[1] - places[0], 30U);
  EXPECT_EQ(places[2] - places[1], 30U);
  EXPECT_EQ(particles.x_px[places[0]], -2.0F);
  EXPECT_EQ(particles.x_px[places[1]], -1.0F);
}

}  // namespace
}  // namespace sketchloc

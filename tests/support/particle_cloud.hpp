#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "filter/particle_spans.hpp"

namespace sketchloc::testing {

/// Particles that own their arrays.
struct ParticleCloud {
  std::vector<float> x_px;
  std::vector<float> y_px;
  std::vector<float> heading_rad;
  std::vector<float> log_scale;
  std::vector<float> axial_strain;
  std::vector<float> diagonal_strain;

  ParticleSpans spans() const {
    return {x_px, y_px, heading_rad, log_scale, axial_strain, diagonal_strain};
  }
  void add(float x, float y, float heading, float scale) {
    x_px.push_back(x);
    y_px.push_back(y);
    heading_rad.push_back(heading);
    log_scale.push_back(std::log(scale));
  }
  /// Gives every particle a strain of its own, ratios of the two directions around 1.8.
  void strain(std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<float> part(0.0F, 0.25F);
    axial_strain.resize(x_px.size());
    diagonal_strain.resize(x_px.size());
    for (std::size_t i = 0; i < x_px.size(); ++i) {
      axial_strain[i] = part(engine);
      diagonal_strain[i] = part(engine);
    }
  }
};

/// Spread evenly over the drawing in all directions: a global start.
inline ParticleCloud spread_cloud(std::size_t particles, int width, int height, double scale,
                                  std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<float> x(0.0F, static_cast<float>(width));
  std::uniform_real_distribution<float> y(0.0F, static_cast<float>(height));
  std::uniform_real_distribution<float> heading(-std::numbers::pi_v<float>,
                                                std::numbers::pi_v<float>);
  std::normal_distribution<float> log_scale(static_cast<float>(std::log(scale)), 0.3F);
  ParticleCloud cloud;
  for (std::size_t i = 0; i < particles; ++i) {
    const float at_x = x(engine);
    const float at_y = y(engine);
    const float turn = heading(engine);
    cloud.add(at_x, at_y, turn, std::exp(log_scale(engine)));
  }
  return cloud;
}

/// Around one pose with 10 px, 0.1 rad and 10 % in scale (1 sigma): a filter that tracks.
inline ParticleCloud tracking_cloud(std::size_t particles, double centre_x, double centre_y,
                                    double scale, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<float> unit;
  ParticleCloud cloud;
  for (std::size_t i = 0; i < particles; ++i) {
    const float x = static_cast<float>(centre_x) + 10.0F * unit(engine);
    const float y = static_cast<float>(centre_y) + 10.0F * unit(engine);
    const float turn = 0.7F + 0.1F * unit(engine);
    cloud.add(x, y, turn, static_cast<float>(scale) * std::exp(0.1F * unit(engine)));
  }
  return cloud;
}

}  // namespace sketchloc::testing

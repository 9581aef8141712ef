#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "filter/particle_spans.hpp"

namespace sketchloc::testing {

/// exp(log_scale) S R(heading) of ParticleSpans, by eigenvalues.
inline Eigen::Matrix2d local_map(const ParticleSpans& particles, std::size_t i) {
  const Eigen::Rotation2Dd rotation(static_cast<double>(particles.heading_rad[i]));
  const double scale = std::exp(static_cast<double>(particles.log_scale[i]));
  if (!particles.strained()) {
    return scale * rotation.toRotationMatrix();
  }
  const double axial = particles.axial_strain[i];
  const double diagonal = particles.diagonal_strain[i];
  const Eigen::Rotation2Dd axes(0.5 * std::atan2(diagonal, axial));
  const double size = std::hypot(axial, diagonal);
  const Eigen::Vector2d ratios(std::exp(size), std::exp(-size));
  return scale * (axes * ratios.asDiagonal() * axes.inverse() * rotation.toRotationMatrix());
}

}  // namespace sketchloc::testing

#pragma once

#include <cstddef>
#include <span>

namespace sketchloc {

/// The state of particles as the kernels read it: arrays of one length, owned by somebody else. The
/// local map robot metres -> sketch pixels of a particle is exp(log_scale) S R(heading), with R a
/// rotation and S = exp([[axial, diagonal], [diagonal, -axial]]) a strain in the sketch frame.
struct ParticleSpans {
  std::span<const float> x_px;
  std::span<const float> y_px;
  std::span<const float> heading_rad;   ///< any turn, |heading| <= 1e4
  std::span<const float> log_scale;     ///< of px/m
  std::span<const float> axial_strain;  ///< both strains empty: all particles are similarities
  std::span<const float> diagonal_strain;

  std::size_t size() const { return x_px.size(); }
  bool strained() const { return !axial_strain.empty(); }

  ParticleSpans subspan(std::size_t offset, std::size_t count) const {
    const auto part = [&](std::span<const float> all) {
      return all.empty() ? all : all.subspan(offset, count);
    };
    return {part(x_px),      part(y_px),         part(heading_rad),
            part(log_scale), part(axial_strain), part(diagonal_strain)};
  }
};

/// Aborts unless all arrays have one length.
void check_lengths(const ParticleSpans& particles);

}  // namespace sketchloc

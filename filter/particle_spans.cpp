#include "filter/particle_spans.hpp"

#include "motion/check.hpp"

namespace sketchloc {

void check_lengths(const ParticleSpans& particles) {
  const std::size_t count = particles.size();
  const std::size_t strains = particles.strained() ? count : 0;
  check(particles.y_px.size() == count && particles.heading_rad.size() == count &&
            particles.log_scale.size() == count && particles.axial_strain.size() == strains &&
            particles.diagonal_strain.size() == strains,
        "all arrays of the particles have one length");
}

}  // namespace sketchloc

#include "filter/resampler.hpp"

#include <algorithm>
#include <utility>

namespace sketchloc {

Resampler::Resampler(const KldParams& params) : params_(params), bins_(params.max_particles) {
  drawn_.reserve(params.max_particles);
  parents_.reserve(params.max_particles);
}

void Resampler::draw(ParticleSet& particles, std::size_t count, Rng& rng) {
  parents_.resize(count);
  systematic_parents(particles.log_weight, parents_, rng);
  drawn_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    drawn_.assign(i, particles, parents_[i]);
    drawn_.log_weight[i] = 0.0F;
  }
  std::swap(particles, drawn_);
}

std::size_t Resampler::adapt(ParticleSet& particles, std::size_t most, double px_per_m, Rng& rng) {
  parents_.resize(std::min(params_.max_particles, most));
  systematic_parents(particles.log_weight, parents_, rng);
  const std::size_t enough = kld_count(count_bins(particles, px_per_m), params_);
  draw(particles, std::min(enough, most), rng);
  return enough;
}

/// That the children of the parents lie in.
std::size_t Resampler::count_bins(const ParticleSet& particles, double px_per_m) {
  bins_.clear();
  const double side_px = params_.bin_m * px_per_m;
  for (const std::uint32_t parent : parents_) {
    bins_.add(pose_bin(particles.x_px[parent], particles.y_px[parent],
                       particles.heading_rad[parent], side_px, params_.bin_rad),
              1.0);
  }
  return bins_.size();
}

void replace_evenly(ParticleSet& particles, const ParticleSet& others,
                    std::span<const std::uint32_t> which, Rng& rng) {
  const double spacing = static_cast<double>(particles.size()) / static_cast<double>(which.size());
  const double offset = uniform(rng);
  for (std::size_t k = 0; k < which.size(); ++k) {
    const auto place = static_cast<std::size_t>((static_cast<double>(k) + offset) * spacing);
    particles.assign(place, others, which[k]);
    particles.log_weight[place] = 0.0F;
  }
}

}  // namespace sketchloc

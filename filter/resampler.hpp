#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "filter/bin_table.hpp"
#include "filter/particle_set.hpp"
#include "filter/resample.hpp"
#include "motion/random.hpp"

namespace sketchloc {

/// Replaces particle sets by equally weighted ones. Keeps its memory.
class Resampler {
 public:
  explicit Resampler(const KldParams& params);

  /// The particles become `count` of them, drawn by their normalised weights.
  void draw(ParticleSet& particles, std::size_t count, Rng& rng);

  /// The same, as many as the K-L bound asks for, but at most `most`. Returns how many it asks for.
  /// `px_per_m`: what makes the bins' side pixels.
  std::size_t adapt(ParticleSet& particles, std::size_t most, double px_per_m, Rng& rng);

 private:
  std::size_t count_bins(const ParticleSet& particles, double px_per_m);

  KldParams params_;
  BinTable bins_;
  ParticleSet drawn_;
  std::vector<std::uint32_t> parents_;
};

/// Copies of some other particles, with a weight of one, take the place of as many particles that
/// are evenly spread over the set; not more than there are.
void replace_evenly(ParticleSet& particles, const ParticleSet& others,
                    std::span<const std::uint32_t> which, Rng& rng);

}  // namespace sketchloc

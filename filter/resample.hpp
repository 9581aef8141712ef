#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "filter/particle_set.hpp"
#include "motion/random.hpp"

namespace sketchloc {

/// Moments of a set of log weights.
struct WeightSummary {
  double log_mean = 0.0;             ///< log of the mean weight
  double effective_particles = 0.0;  ///< 1 / sum of squared normalised weights, in [1, size]
};

/// Normalises log_weight in place so that the mean weight is one (log mean zero). Where every
/// weight is zero or NaN, all become equal: the evidence said nothing.
WeightSummary normalise(ParticleSet& particles);

/// Adaptive particle count by Kullback-Leibler distance sampling. [Fox03]
struct KldParams {
  double error = 0.01;      ///< bound on the K-L distance, in (0, 1)
  double quantile = 2.326;  ///< of the normal distribution, the confidence (0.99), > 0
  double bin_m = 0.5;       ///< side of a bin, in local metres, > 0
  double bin_rad = 0.2618;  ///< width of a heading bin, in (0, pi]
  std::size_t min_particles = 4000;
  std::size_t max_particles = 30000;
};

template <typename Visitor>
void visit_fields(KldParams& params, Visitor&& visit) {
  visit("error", params.error);
  visit("quantile", params.quantile);
  visit("bin_m", params.bin_m);
  visit("bin_rad", params.bin_rad);
  visit("min_particles", params.min_particles);
  visit("max_particles", params.max_particles);
}

void validate(const KldParams& params);

/// The least count for which the K-L distance stays below the bound with that confidence when
/// `occupied_bins` bins are supported, clamped to the limits.
std::size_t kld_count(std::size_t occupied_bins, const KldParams& params);

/// Systematic (low variance) resampling of normalised weights [Thrun05 4.4]: index of the parent of
/// each of parents.size() children. Unbiased for any count.
void systematic_parents(std::span<const float> log_weight, std::span<std::uint32_t> parents,
                        Rng& rng);

}  // namespace sketchloc

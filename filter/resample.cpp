#include "filter/resample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "filter/bin_table.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {

WeightSummary normalise(ParticleSet& particles) {
  std::vector<float>& log_weight = particles.log_weight;
  check(!log_weight.empty(), "a particle set without particles has no weights");
  float largest = -std::numeric_limits<float>::infinity();
  for (float& w : log_weight) {
    w = std::isnan(w) ? -std::numeric_limits<float>::infinity() : w;
    largest = std::max(largest, w);
  }
  if (!std::isfinite(largest)) {
    std::ranges::fill(log_weight, 0.0F);
    return {.log_mean = -std::numeric_limits<double>::infinity(),
            .effective_particles = static_cast<double>(log_weight.size())};
  }
  double sum = 0.0;
  double sum_squares = 0.0;
  for (const float w : log_weight) {
    const double weight = std::exp(w - largest);
    sum += weight;
    sum_squares += weight * weight;
  }
  const double log_mean = largest + std::log(sum / static_cast<double>(log_weight.size()));
  for (float& w : log_weight) {
    w -= static_cast<float>(log_mean);
  }
  return {.log_mean = log_mean, .effective_particles = sum * sum / sum_squares};
}

void validate(const KldParams& params) {
  require_in_range("error", params.error, 1e-6, 1.0);
  require_above("quantile", params.quantile, 0.0);
  require_above("bin_m", params.bin_m, 0.0);
  require_in_range("bin_rad", params.bin_rad, kMinBinRad, std::numbers::pi);
  require_in_range("min_particles", static_cast<double>(params.min_particles), 1.0, 1e7);
  require_in_range("max_particles", static_cast<double>(params.max_particles),
                   static_cast<double>(params.min_particles), 1e7);
}

std::size_t kld_count(std::size_t occupied_bins, const KldParams& params) {
  if (occupied_bins <= 1) {
    return params.min_particles;
  }
  const double k = static_cast<double>(occupied_bins - 1);
  const double a = 2.0 / (9.0 * k);
  const double root = 1.0 - a + std::sqrt(a) * params.quantile;  // Wilson-Hilferty
  const double count = k / (2.0 * params.error) * root * root * root;
  return std::clamp(static_cast<std::size_t>(std::ceil(count)), params.min_particles,
                    params.max_particles);
}

void systematic_parents(std::span<const float> log_weight, std::span<std::uint32_t> parents,
                        Rng& rng) {
  check(!log_weight.empty(), "nothing to resample from");
  double total = 0.0;
  for (const float w : log_weight) {
    total += std::exp(w);
  }
  const double spacing = total / static_cast<double>(parents.size());
  double target = spacing * uniform(rng);
  double passed = std::exp(log_weight[0]);
  std::uint32_t parent = 0;
  for (std::uint32_t& child : parents) {
    while (passed <= target && parent + 1 < log_weight.size()) {
      ++parent;
      passed += std::exp(log_weight[parent]);
    }
    child = parent;
    target += spacing;
  }
}

}  // namespace sketchloc

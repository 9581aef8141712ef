#include "motion/random.hpp"

#include <bit>
#include <random>

namespace sketchloc {
namespace {

/// SplitMix64: turns any 64-bit counter into well mixed bits; the standard seeder of xoshiro.
std::uint64_t split_mix(std::uint64_t& counter) {
  counter += 0x9e3779b97f4a7c15ULL;
  std::uint64_t bits = counter;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31);
}

}  // namespace

Rng::result_type Rng::operator()() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

Rng make_rng(std::uint64_t seed, std::uint64_t step, std::uint64_t chunk) {
  std::uint64_t counter = seed;
  counter = split_mix(counter) ^ step;  // hashed in turn, so (1, 2) and (2, 1) differ
  counter = split_mix(counter) ^ chunk;
  Rng rng;
  for (std::uint64_t& word : rng.state_) {
    word = split_mix(counter);
  }
  return rng;
}

double uniform(Rng& rng) { return static_cast<double>(rng() >> 11) * 0x1.0p-53; }

double uniform(double low, double high, Rng& rng) {
  const double value = low + (high - low) * uniform(rng);
  return value < high ? value : low;  // the sum may round up to the open end
}

double gaussian(double sigma, Rng& rng) {
  std::normal_distribution<double> distribution;  // local: a kept spare value would leak state
  return sigma * distribution(rng);
}

}  // namespace sketchloc

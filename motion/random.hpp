#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace sketchloc {

/// Small, fast, deterministic engine (xoshiro256++ [Blackman21]), usable with the standard
/// distributions. Made only by make_rng, so that every draw is a function of seed, step and chunk.
class Rng {
 public:
  using result_type = std::uint64_t;

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }
  result_type operator()();

 private:
  friend Rng make_rng(std::uint64_t seed, std::uint64_t step, std::uint64_t chunk);
  std::array<std::uint64_t, 4> state_{};
};

/// An engine of its own for one chunk of work in one step of one run.
Rng make_rng(std::uint64_t seed, std::uint64_t step = 0, std::uint64_t chunk = 0);

/// Uniform in [0, 1), 53 random bits.
double uniform(Rng& rng);

/// Uniform in [low, high).
double uniform(double low, double high, Rng& rng);

/// Normal deviate with mean 0 and the given standard deviation (>= 0).
double gaussian(double sigma, Rng& rng);

}  // namespace sketchloc

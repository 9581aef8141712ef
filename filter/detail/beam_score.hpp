#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "filter/particle_view.hpp"

namespace sketchloc::detail {

/// 64 beams, even and odd ones apart: a vector of 16-bit sums of either kind becomes, byte by byte,
/// one vector of 64 table indices.
struct alignas(64) BeamGroup {
  static constexpr std::size_t kBeams = 64;
  static constexpr int kTurn = 1 << 15;      ///< one turn in units of `bearing`
  static constexpr int kUnitsPerCode = 128;  ///< units of `range` per code of the range table

  std::array<std::array<std::uint16_t, 32>, 2> bearing;  ///< plus half a heading of the table
  std::array<std::array<std::int16_t, 32>, 2> range;     ///< at 1 px/m, plus half a code
  std::array<std::uint8_t, 64> valid;                    ///< 0xFF, or 0 where there is no beam
  std::array<std::uint8_t, 64> no_return;                ///< 0xFF where the beam did not return
  bool all_valid;
  bool all_returned;
};

/// Two kernels of 128 values of 16 bit each, by difference of codes modulo 128, low and high bytes
/// apart.
struct alignas(64) KernelTables {
  std::array<std::uint8_t, 128> low;
  std::array<std::uint8_t, 128> high;
  std::array<std::uint8_t, 128> no_return_low;
  std::array<std::uint8_t, 128> no_return_high;
};

/// The range table in plain values.
struct RangeCodes {
  const std::int8_t* codes;
  std::int32_t columns;
  std::int32_t rows;
  float width_px;
  float height_px;
  float cells_per_px;
  float log_step;
};

/// A sum n of kernel integers stands for least + n * unit; outside the drawing n = 0.
struct ScoreScale {
  double unit;
  double least;
};

/// Fills the log-likelihoods of all particles.
void score_beams(const ParticleView& particles, const RangeCodes& table,
                 const KernelTables& kernels, std::span<const BeamGroup> groups,
                 const ScoreScale& scale, std::span<float> log_likelihood);

}  // namespace sketchloc::detail

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "filter/particle_spans.hpp"

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
  std::uint16_t nothing;  ///< of a beam that returned where the drawing has nothing in reach
  bool has_nothing;       ///< false: "nothing" is only the largest code
};

/// What a strain of one size does to a direction, by the direction's angle from the strain's axis
/// in 128 bins: how far it turns it, in 1/512 turn, and how much it stretches it, in half codes.
struct alignas(64) StrainLevel {
  static constexpr double kStep = 1.0 / 64.0;  ///< of strain between levels
  static constexpr int kLevels = 97;  ///< up to 1.5, a ratio of 20 : 1; beyond counts as that

  std::array<std::int8_t, 128> turn;
  std::array<std::int8_t, 128> stretch;
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

/// All that stays the same from scan to scan.
struct BeamTables {
  RangeCodes range;
  const KernelTables* kernels;
  const StrainLevel* strain;  ///< kLevels of them
};

/// Fills the log-likelihoods of all particles.
void score_beams(const ParticleSpans& particles, const BeamTables& tables,
                 std::span<const BeamGroup> groups, const ScoreScale& scale,
                 std::span<float> log_likelihood);

}  // namespace sketchloc::detail

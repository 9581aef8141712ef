#pragma once

#include <cstdint>
#include <span>

#include "filter/end_point_kernel.hpp"

namespace sketchloc::detail {

/// A field of integers, rows from the bottom, with a border of one more column and row at the end.
struct BorderedField {
  const std::uint16_t* cells;
  std::int32_t width;  ///< without the border
  std::int32_t height;
};

/// An integer n stands for n * unit + least per point.
struct EndPointScale {
  double unit;
  double least;
};

/// Fills the log-likelihoods of all particles.
void score_end_points(const ParticleSpans& particles, const EndPoints& points,
                      const BorderedField& field, const EndPointScale& scale,
                      std::span<float> log_likelihood);

}  // namespace sketchloc::detail

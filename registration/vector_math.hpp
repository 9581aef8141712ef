#pragma once

#include <span>

namespace sketchloc {

// Vectorised functions of many numbers that give the same bits on every processor, which those of
// the standard library do not promise. Results go to spans of the same length.

/// Cosine and sine of headings (rad, |heading| <= 1e4), error below 2e-7.
void unit_vectors(std::span<const float> heading_rad, std::span<float> cosine,
                  std::span<float> sine);

/// Natural logarithms of positive normal numbers, error below 2e-7 plus one unit in the last place.
void logarithms(std::span<const float> positive, std::span<float> logarithm);

/// Exponential functions, relative error below 2e-7 for |exponent| <= 80; further ones count as
/// +-80.
void exponentials(std::span<const float> exponent, std::span<float> exponential);

/// Angles of vectors (x, y) in [-pi, pi], error below 1e-6; 0 for the vector 0.
void angles(std::span<const float> x, std::span<const float> y, std::span<float> angle_rad);

}  // namespace sketchloc

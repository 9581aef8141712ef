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

}  // namespace sketchloc

#pragma once

#include <span>

namespace sketchloc {

/// Cosine and sine of many headings (rad, |heading| <= 1e4) into `cosine` and `sine` of the same
/// length: error below 2e-7, vectorised, the same bits on every processor (which the functions of
/// the standard library do not promise).
void unit_vectors(std::span<const float> heading_rad, std::span<float> cosine,
                  std::span<float> sine);

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <span>

namespace sketchloc {

/// Particles as structure of arrays, all of one length, owned by somebody else: the state
/// `sketch_from_robot` of each.
struct ParticleView {
  std::span<const float> x_px;
  std::span<const float> y_px;
  std::span<const float> heading_rad;     ///< any turn, |heading| <= 1e4
  std::span<const float> scale_px_per_m;  ///< > 0

  std::size_t size() const { return x_px.size(); }
};

}  // namespace sketchloc

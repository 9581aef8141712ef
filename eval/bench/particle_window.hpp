#pragma once

#include <cstdint>

#include "tests/support/particle_cloud.hpp"

namespace sketchloc::bench {

/// The next `count` of a million particles, round and round, so that every iteration finds the
/// tables as cold as a filter's update does.
class ParticleWindow {
 public:
  ParticleWindow(std::int64_t count, std::int64_t side_px, bool spread, double px_per_m,
                 bool strained = false)
      : count_(static_cast<std::size_t>(count)) {
    constexpr std::size_t kAll = 1'000'000;
    const int side = static_cast<int>(side_px);
    const double middle = 0.5 * static_cast<double>(side_px);
    cloud_ = spread ? testing::spread_cloud(kAll, side, side, px_per_m, 1)
                    : testing::tracking_cloud(kAll, middle, middle, px_per_m, 1);
    if (strained) {
      cloud_.strain(3);
    }
  }

  ParticleSpans next() {
    from_ = from_ + 2 * count_ <= cloud_.x_px.size() ? from_ + count_ : 0;
    return cloud_.spans().subspan(from_, count_);
  }

 private:
  testing::ParticleCloud cloud_;
  std::size_t count_;
  std::size_t from_ = 0;
};

}  // namespace sketchloc::bench

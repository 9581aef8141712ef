#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "registration/surface_points.hpp"

namespace sketchloc {

/// Merges surface points that many scans saw of the same surface: one mean point and one mean
/// normal per square cell and direction. Keeps its buffers between calls.
class SurfaceMerger {
 public:
  /// Checks that the cell is larger than 0.
  explicit SurfaceMerger(double cell_m);

  /// The merged points, in the order in which their cells were first met; valid until the next
  /// call.
  std::span<const SurfacePoint> merge(std::span<const SurfacePoint> points);

 private:
  struct Key {
    std::int64_t column = 0;
    std::int64_t row = 0;
    std::int64_t direction = 0;  // eighth of the circle that the normal points into
    bool operator==(const Key&) const = default;
  };
  struct Bin {
    Key key;
    double points = 0.0;
    SurfacePoint sum;
  };

  Key key_of(const SurfacePoint& surface) const;
  Bin& bin_of(const Key& key);

  double cell_m_;
  std::vector<std::uint32_t> slots_;  // open addressing: 1 + index of the bin, 0 is free
  std::vector<Bin> bins_;
  std::vector<SurfacePoint> merged_;
};

}  // namespace sketchloc

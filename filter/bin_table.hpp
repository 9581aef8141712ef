#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sketchloc {

/// Narrowest heading bin that a bin number has room for.
constexpr double kMinBinRad = 0.01;

/// Weights summed by bin. Clearing is free and nothing is allocated after construction, so that it
/// serves every step of a filter.
class BinTable {
 public:
  explicit BinTable(std::size_t max_bins);

  void clear();
  /// Adds weight to a bin and returns its sum.
  double add(std::uint64_t bin, double weight);
  std::size_t size() const { return size_; }

 private:
  struct Slot {
    std::uint64_t bin = 0;
    double weight = 0.0;
    std::uint32_t generation = 0;
  };
  std::vector<Slot> slots_;
  std::uint32_t generation_ = 1;
  std::size_t size_ = 0;
};

/// The bin of a pose on a grid of square cells and heading sectors (sector count = full turn /
/// width).
std::uint64_t pose_bin(double x, double y, double heading_rad, double side, double width_rad);

}  // namespace sketchloc

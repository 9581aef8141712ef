#include "filter/bin_table.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "motion/check.hpp"

namespace sketchloc {

BinTable::BinTable(std::size_t max_bins) : slots_(std::bit_ceil(2 * max_bins + 2)) {}

void BinTable::clear() {
  ++generation_;
  size_ = 0;
}

double BinTable::add(std::uint64_t bin, double weight) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>((bin * 0x9e3779b97f4a7c15ULL) >> 20) & mask;
  while (slots_[at].generation == generation_ && slots_[at].bin != bin) {
    at = (at + 1) & mask;
  }
  if (slots_[at].generation != generation_) {
    check(2 * size_ < slots_.size(), "more bins than the table was made for");
    slots_[at] = {.bin = bin, .weight = 0.0, .generation = generation_};
    ++size_;
  }
  return slots_[at].weight += weight;
}

std::uint64_t pose_bin(double x, double y, double heading_rad, double side, double width_rad) {
  constexpr std::int64_t kOffset = 1 << 20;  // keeps coordinates left of the drawing positive
  const auto column =
      static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / side)) + kOffset);
  const auto row =
      static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(y / side)) + kOffset);
  // Floats near -pi come out a little below zero: through a signed number, then wrapped by the
  // mask.
  static_assert(2.0 * std::numbers::pi / kMinBinRad < 1023.0);
  const auto sector = static_cast<std::uint64_t>(
      static_cast<std::int64_t>(std::floor((heading_rad + std::numbers::pi) / width_rad)));
  return (column & 0x3fffffU) << 32 | (row & 0x3fffffU) << 10 | (sector & 0x3ffU);
}

}  // namespace sketchloc

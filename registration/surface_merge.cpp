#include "registration/surface_merge.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "motion/check.hpp"

namespace sketchloc {

SurfaceMerger::SurfaceMerger(double cell_m) : cell_m_(cell_m) {
  check(cell_m > 0.0, "cells are larger than 0");
}

SurfaceMerger::Key SurfaceMerger::key_of(const SurfacePoint& surface) const {
  // Eighth of the circle by three comparisons: much cheaper than atan2.
  const double x = surface.normal.x();
  const double y = surface.normal.y();
  const std::int64_t direction =
      (x >= 0.0 ? 1 : 0) + (y >= 0.0 ? 2 : 0) + (std::abs(x) >= std::abs(y) ? 4 : 0);
  return {static_cast<std::int64_t>(std::floor(surface.point.x() / cell_m_)),
          static_cast<std::int64_t>(std::floor(surface.point.y() / cell_m_)), direction};
}

SurfaceMerger::Bin& SurfaceMerger::bin_of(const Key& key) {
  const std::size_t mask = slots_.size() - 1;
  const std::uint64_t mixed = (static_cast<std::uint64_t>(key.column) * 0x9E3779B97F4A7C15ULL) ^
                              (static_cast<std::uint64_t>(key.row) * 0xC2B2AE3D27D4EB4FULL) ^
                              (static_cast<std::uint64_t>(key.direction) * 0x165667B19E3779F9ULL);
  for (std::size_t slot = (mixed >> 32) & mask;; slot = (slot + 1) & mask) {
    if (slots_[slot] == 0) {
      bins_.push_back({key, 0.0, {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()}});
      slots_[slot] = static_cast<std::uint32_t>(bins_.size());
      return bins_.back();
    }
    Bin& bin = bins_[slots_[slot] - 1];
    if (bin.key == key) {
      return bin;
    }
  }
}

std::span<const SurfacePoint> SurfaceMerger::merge(std::span<const SurfacePoint> points) {
  bins_.clear();
  slots_.assign(std::bit_ceil(2 * points.size() + 2), 0);
  for (const SurfacePoint& surface : points) {
    Bin& bin = bin_of(key_of(surface));
    bin.points += 1.0;
    bin.sum.point += surface.point;
    bin.sum.normal += surface.normal;
  }
  merged_.clear();
  for (const Bin& bin : bins_) {
    merged_.push_back({bin.sum.point / bin.points, bin.sum.normal.normalized()});
  }
  return merged_;
}

}  // namespace sketchloc

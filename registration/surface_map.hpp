#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "registration/surface_points.hpp"

namespace sketchloc {

/// Nearest-neighbour look-up in a set of surface points: square buckets over their bounding box.
/// Refilling keeps the memory, so that a map which moves along with the robot does not allocate.
class SurfaceMap {
 public:
  /// Checks that the search radius is above 0.
  explicit SurfaceMap(double search_radius_m);

  void refill(std::span<const SurfacePoint> points);

  /// The nearest point within the search radius whose normal agrees up to about 45 deg; null if
  /// there is none.
  const SurfacePoint* nearest(const SurfacePoint& query) const;

  std::size_t size() const { return points_.size(); }
  double search_radius_m() const { return search_radius_m_; }
  std::span<const SurfacePoint> points() const { return points_; }

 private:
  std::size_t bucket_of(const Eigen::Vector2d& point) const;

  double search_radius_m_;
  Eigen::Vector2d low_corner_ = Eigen::Vector2d::Zero();
  std::ptrdiff_t columns_ = 0;
  std::ptrdiff_t rows_ = 0;
  std::vector<SurfacePoint> points_;         // sorted by bucket
  std::vector<std::uint32_t> bucket_start_;  // one past the last bucket: number of points
};

}  // namespace sketchloc

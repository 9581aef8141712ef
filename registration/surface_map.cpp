#include "registration/surface_map.hpp"

#include <algorithm>
#include <cmath>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastNormalCosine = 0.7;

}  // namespace

SurfaceMap::SurfaceMap(double search_radius_m) : search_radius_m_(search_radius_m) {
  check(search_radius_m > 0.0, "the search radius is above 0");
}

std::size_t SurfaceMap::bucket_of(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d offset = (point - low_corner_) / search_radius_m_;
  const auto column = static_cast<std::ptrdiff_t>(offset.x());
  const auto row = static_cast<std::ptrdiff_t>(offset.y());
  return static_cast<std::size_t>(row * columns_ + column);
}

void SurfaceMap::refill(std::span<const SurfacePoint> points) {
  points_.clear();
  bucket_start_.clear();
  columns_ = rows_ = 0;
  if (points.empty()) {
    return;
  }
  Eigen::Vector2d low = points.front().point;
  Eigen::Vector2d high = low;
  for (const SurfacePoint& surface : points) {
    low = low.cwiseMin(surface.point);
    high = high.cwiseMax(surface.point);
  }
  // One empty bucket all around: the neighbours of an occupied bucket always exist.
  low_corner_ = low - Eigen::Vector2d::Constant(search_radius_m_);
  columns_ = static_cast<std::ptrdiff_t>((high - low).x() / search_radius_m_) + 3;
  rows_ = static_cast<std::ptrdiff_t>((high - low).y() / search_radius_m_) + 3;

  // Counting sort by bucket.
  bucket_start_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const SurfacePoint& surface : points) {
    ++bucket_start_[bucket_of(surface.point) + 1];
  }
  for (std::size_t bucket = 1; bucket < bucket_start_.size(); ++bucket) {
    bucket_start_[bucket] += bucket_start_[bucket - 1];
  }
  points_.resize(points.size());
  for (auto surface = points.rbegin(); surface != points.rend(); ++surface) {
    points_[--bucket_start_[bucket_of(surface->point) + 1]] = *surface;
  }
  // Filling from the back has moved each start one bucket up.
  std::rotate(bucket_start_.begin(), bucket_start_.begin() + 1, bucket_start_.end());
  bucket_start_.back() = static_cast<std::uint32_t>(points.size());
}

const SurfacePoint* SurfaceMap::nearest(const SurfacePoint& query) const {
  const Eigen::Vector2d offset = (query.point - low_corner_) / search_radius_m_;
  if (!(offset.x() >= 0.0 && offset.y() >= 0.0 && offset.x() < static_cast<double>(columns_) &&
        offset.y() < static_cast<double>(rows_))) {
    return nullptr;
  }
  const auto column = static_cast<std::ptrdiff_t>(offset.x());
  const auto row = static_cast<std::ptrdiff_t>(offset.y());
  const std::ptrdiff_t left = std::max<std::ptrdiff_t>(column - 1, 0);
  const std::ptrdiff_t right = std::min(column + 1, columns_ - 1);
  const SurfacePoint* best = nullptr;
  double best_square = search_radius_m_ * search_radius_m_;
  for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(row - 1, 0); r <= std::min(row + 1, rows_ - 1);
       ++r) {
    // Buckets of one row lie side by side: one run of points.
    const std::uint32_t begin = bucket_start_[static_cast<std::size_t>(r * columns_ + left)];
    const std::uint32_t end = bucket_start_[static_cast<std::size_t>(r * columns_ + right) + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const double square = (points_[i].point - query.point).squaredNorm();
      if (square < best_square && points_[i].normal.dot(query.normal) > kLeastNormalCosine) {
        best_square = square;
        best = &points_[i];
      }
    }
  }
  return best;
}

}  // namespace sketchloc

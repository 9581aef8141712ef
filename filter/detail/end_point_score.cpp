#include "filter/detail/end_point_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "registration/vector_math.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/detail/end_point_score.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

// Shared by all instruction sets.
#ifndef SKETCHLOC_FILTER_END_POINT_SCORE_ONCE
#define SKETCHLOC_FILTER_END_POINT_SCORE_ONCE
namespace sketchloc::detail {

constexpr std::size_t kBlock = 256;  ///< particles whose maps are made together

/// The maps robot m -> cells of the bordered field of a block of particles, by coefficient.
struct alignas(64) BlockMaps {
  std::array<float, kBlock> xx;
  std::array<float, kBlock> xy;
  std::array<float, kBlock> yx;
  std::array<float, kBlock> yy;
  std::array<float, kBlock> x;
  std::array<float, kBlock> y;
};

}  // namespace sketchloc::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace sketchloc::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using F = hn::ScalableTag<float>;
using U = hn::RebindToUnsigned<F>;

/// The map of one particle and the field, spread over vectors.
struct PointMap {
  hn::Vec<F> xx, xy, yx, yy, x, y;
  hn::Vec<U> border_column, border_row, pitch;

  HWY_INLINE PointMap(const BlockMaps& maps, std::size_t i, const BorderedField& field)
      : xx(hn::Set(F(), maps.xx[i])),
        xy(hn::Set(F(), maps.xy[i])),
        yx(hn::Set(F(), maps.yx[i])),
        yy(hn::Set(F(), maps.yy[i])),
        x(hn::Set(F(), maps.x[i])),
        y(hn::Set(F(), maps.y[i])),
        border_column(hn::Set(U(), static_cast<std::uint32_t>(field.width))),
        border_row(hn::Set(U(), static_cast<std::uint32_t>(field.height))),
        pitch(hn::Set(U(), static_cast<std::uint32_t>(field.width) + 1)) {}

  /// Index of the cell of the bordered field that holds each point; the border takes all outside.
  HWY_INLINE hn::Vec<U> cells(hn::Vec<F> x_m, hn::Vec<F> y_m) const {
    const auto column = hn::Add(x, hn::Add(hn::Mul(xx, x_m), hn::Mul(xy, y_m)));
    const auto row = hn::Add(y, hn::Add(hn::Mul(yx, x_m), hn::Mul(yy, y_m)));
    return hn::Add(hn::Mul(hn::Min(nearest(row), border_row), pitch),
                   hn::Min(nearest(column), border_column));
  }

 private:
  /// The nearest integer of a number within +-2^22. Adding 1.5 x 2^23 leaves it in the low bits;
  /// all else, be it negative, larger, infinite or no number, becomes an integer beyond any border.
  static HWY_INLINE hn::Vec<U> nearest(hn::Vec<F> number) {
    constexpr float kMagic = 12582912.0F;
    const auto bits = hn::BitCast(U(), hn::Add(number, hn::Set(F(), kMagic)));
    return hn::Sub(bits, hn::BitCast(U(), hn::Set(F(), kMagic)));
  }
};

/// The points of a scan, its last incomplete vector filled up.
class PointVectors {
 public:
  explicit PointVectors(const EndPoints& points)
      : points_(points), whole_(points.size() / kLanes * kLanes) {
    std::ranges::copy(points.x_m.subspan(whole_), last_x_.begin());
    std::ranges::copy(points.y_m.subspan(whole_), last_y_.begin());
  }

  std::size_t size() const { return points_.size(); }
  HWY_INLINE hn::Vec<F> x_m(std::size_t i) const {
    return hn::LoadU(F(), i < whole_ ? points_.x_m.data() + i : last_x_.data());
  }
  HWY_INLINE hn::Vec<F> y_m(std::size_t i) const {
    return hn::LoadU(F(), i < whole_ ? points_.y_m.data() + i : last_y_.data());
  }

  static constexpr std::size_t kLanes = hn::MaxLanes(F());

 private:
  EndPoints points_;
  std::size_t whole_;  ///< points in whole vectors
  std::array<float, kLanes> last_x_{};
  std::array<float, kLanes> last_y_{};
};

/// The sum of the cells at `count` indices. Loads one by one are faster than the gather instruction
/// on many processors and never slower by much (end_point_kernel_bench).
HWY_INLINE std::uint64_t sum_cells(const std::uint16_t* cells, const std::uint32_t* index,
                                   std::size_t count) {
  std::array<std::uint32_t, 4> sums{};  // do not wait for each other
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    sums[0] += cells[index[i]];
    sums[1] += cells[index[i + 1]];
    sums[2] += cells[index[i + 2]];
    sums[3] += cells[index[i + 3]];
  }
  for (; i < count; ++i) {
    sums[0] += cells[index[i]];
  }
  return std::uint64_t{sums[0]} + sums[1] + sums[2] + sums[3];
}

HWY_INLINE std::uint64_t sum_particle(const PointMap& map, const PointVectors& points,
                                      const BorderedField& field) {
  constexpr std::size_t kStretch = 64;  // so few that loads overlap with the next stretch's maths
  HWY_ALIGN std::array<std::uint32_t, kStretch> index;
  std::uint64_t sum = 0;
  for (std::size_t from = 0; from < points.size(); from += kStretch) {
    const std::size_t count = std::min(kStretch, points.size() - from);
    for (std::size_t i = 0; i < count; i += PointVectors::kLanes) {
      const auto cells = map.cells(points.x_m(from + i), points.y_m(from + i));
      hn::Store(cells, U(), index.data() + i);
    }
    sum += sum_cells(field.cells, index.data(), count);
  }
  return sum;
}

void sum_block(const BlockMaps& maps, const EndPoints& points, const BorderedField& field,
               const EndPointScale& scale, std::span<float> log_likelihood) {
  const double least = scale.least * static_cast<double>(points.size());
  const PointVectors vectors(points);
  for (std::size_t i = 0; i < log_likelihood.size(); ++i) {
    const std::uint64_t sum = sum_particle(PointMap(maps, i, field), vectors, field);
    log_likelihood[i] = static_cast<float>(least + static_cast<double>(sum) * scale.unit);
  }
}

}  // namespace
}  // namespace sketchloc::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc::detail {
namespace {

HWY_EXPORT(sum_block);

/// Multiplies exp([[axial, diagonal], [diagonal, -axial]]) = cosh(size) 1 + sinh(size) / size
/// [[axial, diagonal], [diagonal, -axial]] from the left; both functions by their series in size^2,
/// exact to float up to a size of 2, which is a ratio of 55 : 1 and as far as strains count.
void strain_maps(const ParticleSpans& block, BlockMaps& maps) {
  for (std::size_t i = 0; i < block.size(); ++i) {
    const float axial = block.axial_strain[i];
    const float diagonal = block.diagonal_strain[i];
    const float z = std::min(axial * axial + diagonal * diagonal, 4.0F);
    float cosh = 1.0F;
    float sinh_over_size = 1.0F;
    for (int n = 12; n >= 2; n -= 2) {
      const auto k = static_cast<float>(n);
      cosh = 1.0F + cosh * z / (k * (k - 1.0F));
      sinh_over_size = 1.0F + sinh_over_size * z / (k * (k + 1.0F));
    }
    const float along = axial * sinh_over_size;
    const float across = diagonal * sinh_over_size;
    const float xx = maps.xx[i];
    const float xy = maps.xy[i];
    maps.xx[i] = (cosh + along) * xx + across * maps.yx[i];
    maps.xy[i] = (cosh + along) * xy + across * maps.yy[i];
    maps.yx[i] = (cosh - along) * maps.yx[i] + across * xx;
    maps.yy[i] = (cosh - along) * maps.yy[i] + across * xy;
  }
}

/// From cell units to the number of the nearest cell centre. The last part lets a point exactly on
/// a side fall into the upper cell, as everywhere.
constexpr float kToNearest = -0.5F + 1.0F / 4096.0F;

/// scale S R(heading) of every particle.
BlockMaps make_maps(const ParticleSpans& block) {
  const std::size_t count = block.size();
  BlockMaps maps;
  std::array<float, kBlock> scale;
  unit_vectors(block.heading_rad, std::span(maps.xx).first(count), std::span(maps.yx).first(count));
  exponentials(block.log_scale, std::span(scale).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    maps.xx[i] *= scale[i];
    maps.yx[i] *= scale[i];
    maps.xy[i] = -maps.yx[i];
    maps.yy[i] = maps.xx[i];
    // The exponential hides a log-scale that is not finite.
    const bool usable = std::isfinite(block.log_scale[i]);
    maps.x[i] = usable ? block.x_px[i] + kToNearest : std::numeric_limits<float>::quiet_NaN();
    maps.y[i] = block.y_px[i] + kToNearest;
  }
  if (block.strained()) {
    strain_maps(block, maps);
  }
  return maps;
}

}  // namespace

void score_end_points(const ParticleSpans& particles, const EndPoints& points,
                      const BorderedField& field, const EndPointScale& scale,
                      std::span<float> log_likelihood) {
  for (std::size_t from = 0; from < particles.size(); from += kBlock) {
    const std::size_t count = std::min(kBlock, particles.size() - from);
    const BlockMaps maps = make_maps(particles.subspan(from, count));
    HWY_DYNAMIC_DISPATCH(sum_block)
    (maps, points, field, scale, log_likelihood.subspan(from, count));
  }
}

}  // namespace sketchloc::detail
#endif

#include "registration/ray_caster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motion/check.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/ray_caster.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "registration/detail/simd_math-inl.hpp"

#ifndef SKETCHLOC_REGISTRATION_RAY_CASTER_ONCE
#define SKETCHLOC_REGISTRATION_RAY_CASTER_ONCE
namespace sketchloc::detail {

/// What a cast needs, in plain values.
struct CastRequest {
  const std::uint8_t* free_squares;  ///< four planes, one per quadrant, and three bytes more
  std::int32_t width;
  std::int32_t height;
  float origin_x;
  float origin_y;
  float max_range;
};

}  // namespace sketchloc::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace sketchloc::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using detail::CastRequest;

/// One coordinate of a group of rays: everything that stays fixed while they travel.
template <class V>
struct Axis {
  V origin;
  V direction;
  V inverse;  ///< 1 / direction
  V sign;     ///< -1 or 1
  V behind;   ///< 1 where the ray travels down (a cell's far side is its lower one), else 0
  V last;     ///< largest index of a cell
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE Axis<V> make_axis(D d, float origin, V direction, std::int32_t size) {
  // A ray exactly along the other axis takes "for ever" to the next side, never 0 / 0.
  const V tiny = hn::CopySign(hn::Set(d, 1e-12F), direction);
  const V safe = hn::IfThenElse(hn::Lt(hn::Abs(direction), hn::Set(d, 1e-12F)), tiny, direction);
  const V one = hn::Set(d, 1.0F);
  const auto down = hn::Lt(safe, hn::Zero(d));
  return {hn::Set(d, origin),
          safe,
          hn::Div(one, safe),
          hn::CopySign(one, safe),
          hn::IfThenElseZero(down, one),
          hn::Set(d, static_cast<float>(size - 1))};
}

/// Distance at which the ray has passed `length` cells of this axis beyond the near side of `cell`.
template <class V>
HWY_INLINE V distance_through(const Axis<V>& axis, V cell, V length) {
  const V side = hn::Add(hn::Add(cell, axis.behind), hn::Mul(axis.sign, length));
  return hn::Mul(hn::Sub(side, axis.origin), axis.inverse);
}

template <class V>
HWY_INLINE V cell_after(const Axis<V>& axis, V distance) {
  return hn::Floor(hn::Add(axis.origin, hn::Mul(distance, axis.direction)));
}

/// Bytes at offsets, one per lane.
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE VI gather_bytes(DI di, const std::uint8_t* bytes, VI offset) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  // Reads three bytes too many, which are there.
  const auto* words = reinterpret_cast<const std::int32_t*>(bytes);
  return hn::And(hn::GatherOffset(di, words, offset), hn::Set(di, 0xFF));
#else
  HWY_ALIGN std::array<std::int32_t, hn::MaxLanes(di)> lanes;
  hn::Store(offset, di, lanes.data());
  std::ranges::transform(lanes, lanes.begin(), [bytes](std::int32_t at) { return bytes[at]; });
  return hn::Load(di, lanes.data());
#endif
}

/// One vector of rays on their way.
template <class D>
class Rays {
 public:
  using V = hn::Vec<D>;
  using DI = hn::RebindToSigned<D>;

  HWY_INLINE void start(const CastRequest& request, V heading_rad) {
    const D d;
    const V zero = hn::Zero(d);
    const auto unit = detail::HWY_NAMESPACE::unit_vector(d, heading_rad);
    x_ = make_axis(d, request.origin_x, unit.cosine, request.width);
    y_ = make_axis(d, request.origin_y, unit.sine, request.height);
    const V quadrant = hn::Add(x_.behind, hn::Add(y_.behind, y_.behind));
    plane_ = hn::Mul(hn::ConvertTo(DI(), quadrant), hn::Set(DI(), request.width * request.height));
    range_ = hn::Set(d, request.max_range);

    // Enter the grid (at distance 0 where the origin is inside).
    const V first_x = hn::IfThenElseZero(hn::Gt(x_.behind, zero), x_.last);
    const V first_y = hn::IfThenElseZero(hn::Gt(y_.behind, zero), y_.last);
    const V enter =
        hn::Max(distance_through(x_, first_x, zero), distance_through(y_, first_y, zero));
    const V one = hn::Set(d, 1.0F);
    const V leave = hn::Min(distance_through(x_, first_x, hn::Add(x_.last, one)),
                            distance_through(y_, first_y, hn::Add(y_.last, one)));
    distance_ = hn::Max(zero, enter);
    column_ = hn::Min(hn::Max(cell_after(x_, distance_), zero), x_.last);
    row_ = hn::Min(hn::Max(cell_after(y_, distance_), zero), y_.last);
    travelling_ = hn::And(hn::Lt(distance_, leave), hn::Lt(distance_, range_));
  }

  HWY_INLINE bool arrived() const { return hn::AllFalse(D(), travelling_); }
  HWY_INLINE V range() const { return range_; }

  /// Leaves the free square of the current cell through exactly one of its sides, so that no stroke
  /// is ever jumped, not even across a corner.
  HWY_INLINE void step(const CastRequest& request) {
    const D d;
    const V zero = hn::Zero(d);
    const auto cell = hn::Add(hn::Mul(hn::ConvertTo(DI(), row_), hn::Set(DI(), request.width)),
                              hn::ConvertTo(DI(), column_));
    const V side =
        hn::ConvertTo(d, gather_bytes(DI(), request.free_squares, hn::Add(plane_, cell)));
    const auto hit = hn::And(travelling_, hn::Eq(side, zero));
    range_ = hn::IfThenElse(hit, distance_, range_);
    travelling_ = hn::AndNot(hit, travelling_);

    const V through_x = distance_through(x_, column_, side);
    const V through_y = distance_through(y_, row_, side);
    const auto leaves_by_x = hn::Le(through_x, through_y);
    distance_ = hn::Min(through_x, through_y);

    // Along the side that is left the next cell is known; the other coordinate stays in the square.
    const V beyond_column = hn::Add(column_, hn::Mul(x_.sign, side));
    const V beyond_row = hn::Add(row_, hn::Mul(y_.sign, side));
    const V next_column =
        hn::IfThenElse(leaves_by_x, beyond_column, within(x_, column_, beyond_column));
    const V next_row = hn::IfThenElse(leaves_by_x, within(y_, row_, beyond_row), beyond_row);

    const auto in_x = hn::And(hn::Ge(next_column, zero), hn::Le(next_column, x_.last));
    const auto in_y = hn::And(hn::Ge(next_row, zero), hn::Le(next_row, y_.last));
    const auto in_reach = hn::Lt(distance_, hn::Set(d, request.max_range));
    travelling_ = hn::And(hn::And(travelling_, in_reach), hn::And(in_x, in_y));
    column_ = hn::IfThenElse(travelling_, next_column, column_);
    row_ = hn::IfThenElse(travelling_, next_row, row_);
  }

 private:
  /// The cell after the current distance, kept between `cell` and the last one before `beyond`.
  HWY_INLINE V within(const Axis<V>& axis, V cell, V beyond) const {
    const V last = hn::Sub(beyond, axis.sign);
    return hn::Min(hn::Max(cell_after(axis, distance_), hn::Min(cell, last)), hn::Max(cell, last));
  }

  Axis<V> x_;
  Axis<V> y_;
  hn::Vec<DI> plane_;  ///< where the squares of this quadrant of directions begin
  V column_;
  V row_;
  V distance_;
  V range_;
  hn::Mask<D> travelling_;
};

/// Casts several vectors at a time, whose look-ups do not wait for each other.
void cast_all(const CastRequest& request, const float* heading_rad, std::size_t count,
              float* ranges) {
  using D = hn::ScalableTag<float>;
  constexpr std::size_t kLanes = hn::MaxLanes(D());
  constexpr std::size_t kVectors = 4;
  constexpr std::size_t kRays = kLanes * kVectors;
  HWY_ALIGN std::array<float, kRays> buffer{};
  std::array<Rays<D>, kVectors> rays;
  for (std::size_t from = 0; from < count; from += kRays) {
    const std::size_t here = std::min(kRays, count - from);
    const std::size_t vectors = (here + kLanes - 1) / kLanes;
    std::copy_n(heading_rad + from, here, buffer.begin());
    std::fill(buffer.begin() + static_cast<std::ptrdiff_t>(here), buffer.end(), heading_rad[from]);
    for (std::size_t v = 0; v < vectors; ++v) {
      rays[v].start(request, hn::Load(D(), buffer.data() + v * kLanes));
    }
    bool travelling = true;
    while (travelling) {
      travelling = false;
      for (std::size_t v = 0; v < vectors; ++v) {
        if (!rays[v].arrived()) {
          rays[v].step(request);
          travelling = true;
        }
      }
    }
    for (std::size_t v = 0; v < vectors; ++v) {
      hn::Store(rays[v].range(), D(), buffer.data() + v * kLanes);
    }
    std::copy_n(buffer.begin(), here, ranges + from);
  }
}

}  // namespace
}  // namespace sketchloc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc {
namespace {

constexpr int kLongestSide = 255;

/// Fills one quadrant's plane: the free square of a cell is one larger than the smallest of its
/// three neighbours in that quadrant. Outside the grid all is free.
void fill_quadrant(const Grid<std::uint8_t>& occupied, bool down_x, bool down_y,
                   std::uint8_t* plane) {
  const int width = occupied.width();
  const int height = occupied.height();
  std::vector<int> previous(static_cast<std::size_t>(width) + 1, kLongestSide);
  for (int j = 0; j < height; ++j) {
    const int row = down_y ? j : height - 1 - j;
    const std::span<const std::uint8_t> cells = occupied.row(row);
    std::uint8_t* sides = plane + static_cast<std::ptrdiff_t>(row) * width;
    int beside = kLongestSide;    // the neighbour in this row, done before
    int diagonal = kLongestSide;  // the neighbour across the corner, in the previous row
    for (int i = 0; i < width; ++i) {
      const auto column = static_cast<std::size_t>(down_x ? i : width - 1 - i);
      const int straight = previous[column];
      const int smallest = std::min(straight, std::min(diagonal, beside));
      const int side = cells[column] != 0 ? 0 : std::min(smallest + 1, kLongestSide);
      diagonal = straight;
      previous[column] = side;
      beside = side;
      sides[column] = static_cast<std::uint8_t>(side);
    }
  }
}

}  // namespace

RayCaster::RayCaster(const Grid<std::uint8_t>& occupied)
    : width_(occupied.width()), height_(occupied.height()) {
  const std::size_t plane = occupied.cells().size();
  check(plane < (std::size_t{1} << 29), "a grid of at most 2^29 cells");
  free_squares_.resize(4 * plane + 3);
  for (const bool down_y : {false, true}) {
    for (const bool down_x : {false, true}) {
      const std::size_t quadrant = (down_x ? 1U : 0U) + (down_y ? 2U : 0U);
      fill_quadrant(occupied, down_x, down_y, free_squares_.data() + quadrant * plane);
    }
  }
}

HWY_EXPORT(cast_all);

void RayCaster::cast(const Eigen::Vector2d& origin, std::span<const float> heading_rad,
                     float max_range, std::span<float> ranges) const {
  check(ranges.size() == heading_rad.size(), "one range per heading");
  check(origin.allFinite() && std::isfinite(max_range), "rays start at a finite point");
  if (width_ == 0 || height_ == 0) {
    std::fill(ranges.begin(), ranges.end(), max_range);
    return;
  }
  const detail::CastRequest request{.free_squares = free_squares_.data(),
                                    .width = width_,
                                    .height = height_,
                                    .origin_x = static_cast<float>(origin.x()),
                                    .origin_y = static_cast<float>(origin.y()),
                                    .max_range = max_range};
  HWY_DYNAMIC_DISPATCH(cast_all)(request, heading_rad.data(), heading_rad.size(), ranges.data());
}

float RayCaster::range(const Eigen::Vector2d& origin, float heading_rad, float max_range) const {
  float result = max_range;
  cast(origin, {&heading_rad, 1}, max_range, {&result, 1});
  return result;
}

}  // namespace sketchloc
#endif

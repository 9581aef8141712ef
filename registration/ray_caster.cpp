#include "registration/ray_caster.hpp"

#include <algorithm>
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
  const std::uint32_t* free_squares;
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

/// The ranges of one vector of rays. Each turn of the loop leaves the free square of the current
/// cell through exactly one of its sides, so no stroke is ever jumped, not even across a corner.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V cast_rays(D d, const CastRequest& request, V heading_rad) {
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, 1.0F);
  const V max_range = hn::Set(d, request.max_range);
  const auto width = hn::Set(di, request.width);
  const auto byte = hn::Set(di, 0xFF);

  const auto unit = detail::HWY_NAMESPACE::unit_vector(d, heading_rad);
  const Axis<V> x = make_axis(d, request.origin_x, unit.cosine, request.width);
  const Axis<V> y = make_axis(d, request.origin_y, unit.sine, request.height);
  const V quadrant = hn::Add(x.behind, hn::Add(y.behind, y.behind));
  const auto shift = hn::BitCast(du, hn::ShiftLeft<3>(hn::ConvertTo(di, quadrant)));

  // Enter the grid (at distance 0 where the origin is inside).
  const V first_x = hn::IfThenElseZero(hn::Gt(x.behind, zero), x.last);
  const V first_y = hn::IfThenElseZero(hn::Gt(y.behind, zero), y.last);
  const V enter_x = distance_through(x, first_x, zero);
  const V enter_y = distance_through(y, first_y, zero);
  V distance = hn::Max(zero, hn::Max(enter_x, enter_y));
  const V leave = hn::Min(distance_through(x, first_x, hn::Add(x.last, one)),
                          distance_through(y, first_y, hn::Add(y.last, one)));
  V column = hn::Min(hn::Max(cell_after(x, distance), zero), x.last);
  V row = hn::Min(hn::Max(cell_after(y, distance), zero), y.last);

  V range = max_range;
  auto travelling = hn::And(hn::Lt(distance, leave), hn::Lt(distance, max_range));
  while (!hn::AllFalse(d, travelling)) {
    const auto cell = hn::Add(hn::Mul(hn::ConvertTo(di, row), width), hn::ConvertTo(di, column));
    const auto squares = hn::GatherIndex(du, request.free_squares, cell);
    const V side = hn::ConvertTo(d, hn::And(hn::BitCast(di, hn::Shr(squares, shift)), byte));

    const auto hit = hn::And(travelling, hn::Eq(side, zero));
    range = hn::IfThenElse(hit, distance, range);
    travelling = hn::AndNot(hit, travelling);

    const V through_x = distance_through(x, column, side);
    const V through_y = distance_through(y, row, side);
    const auto leaves_by_x = hn::Le(through_x, through_y);
    distance = hn::Min(through_x, through_y);

    // Along the side that is left the next cell is known; the other coordinate stays in the square.
    const V beyond_column = hn::Add(column, hn::Mul(x.sign, side));
    const V beyond_row = hn::Add(row, hn::Mul(y.sign, side));
    const V last_column = hn::Sub(beyond_column, x.sign);
    const V last_row = hn::Sub(beyond_row, y.sign);
    const V within_column = hn::Min(hn::Max(cell_after(x, distance), hn::Min(column, last_column)),
                                    hn::Max(column, last_column));
    const V within_row =
        hn::Min(hn::Max(cell_after(y, distance), hn::Min(row, last_row)), hn::Max(row, last_row));
    const V next_column = hn::IfThenElse(leaves_by_x, beyond_column, within_column);
    const V next_row = hn::IfThenElse(leaves_by_x, within_row, beyond_row);

    const auto inside = hn::And(hn::And(hn::Ge(next_column, zero), hn::Le(next_column, x.last)),
                                hn::And(hn::Ge(next_row, zero), hn::Le(next_row, y.last)));
    travelling = hn::And(travelling, hn::And(inside, hn::Lt(distance, max_range)));
    column = hn::IfThenElse(travelling, next_column, column);
    row = hn::IfThenElse(travelling, next_row, row);
  }
  return range;
}

void cast_all(const CastRequest& request, const float* heading_rad, std::size_t count,
              float* ranges) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    hn::StoreU(cast_rays(d, request, hn::LoadU(d, heading_rad + i)), d, ranges + i);
  }
  if (i < count) {
    HWY_ALIGN float buffer[hn::MaxLanes(d)];
    std::fill(std::copy(heading_rad + i, heading_rad + count, buffer), buffer + lanes,
              heading_rad[i]);
    hn::Store(cast_rays(d, request, hn::Load(d, buffer)), d, buffer);
    std::copy(buffer, buffer + (count - i), ranges + i);
  }
}

}  // namespace
}  // namespace sketchloc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc {
namespace {

constexpr int kLongestSide = 255;

/// Writes one quadrant's byte of every cell: the free square of a cell is one larger than the
/// smallest of its three neighbours in that quadrant. Outside the grid all is free.
void fill_quadrant(const Grid<std::uint8_t>& occupied, bool down_x, bool down_y,
                   Grid<std::uint32_t>& squares) {
  const int width = occupied.width();
  const int height = occupied.height();
  const int shift = 8 * (static_cast<int>(down_x) + 2 * static_cast<int>(down_y));
  std::vector<int> previous(static_cast<std::size_t>(width) + 1, kLongestSide);
  for (int j = 0; j < height; ++j) {
    const int row = down_y ? j : height - 1 - j;
    const std::span<const std::uint8_t> cells = occupied.row(row);
    const std::span<std::uint32_t> sides = squares.row(row);
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
      sides[column] |= static_cast<std::uint32_t>(side) << shift;
    }
  }
}

}  // namespace

RayCaster::RayCaster(const Grid<std::uint8_t>& occupied)
    : free_squares_(occupied.width(), occupied.height()) {
  for (const bool down_y : {false, true}) {
    for (const bool down_x : {false, true}) {
      fill_quadrant(occupied, down_x, down_y, free_squares_);
    }
  }
}

HWY_EXPORT(cast_all);

void RayCaster::cast(const Eigen::Vector2d& origin, std::span<const float> heading_rad,
                     float max_range, std::span<float> ranges) const {
  check(ranges.size() == heading_rad.size(), "one range per heading");
  check(origin.allFinite() && std::isfinite(max_range), "rays start at a finite point");
  if (free_squares_.empty()) {
    std::fill(ranges.begin(), ranges.end(), max_range);
    return;
  }
  const detail::CastRequest request{.free_squares = free_squares_.cells().data(),
                                    .width = width(),
                                    .height = height(),
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

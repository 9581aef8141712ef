#include "filter/detail/beam_score.hpp"

#include <algorithm>
#include <numbers>

#include "registration/vector_math.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/detail/beam_score.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "filter/detail/byte_table-inl.hpp"

// Shared by all instruction sets.
#ifndef SKETCHLOC_FILTER_BEAM_SCORE_ONCE
#define SKETCHLOC_FILTER_BEAM_SCORE_ONCE
namespace sketchloc::detail {

constexpr std::size_t kBlock = 256;  ///< particles whose places are found together
constexpr std::int32_t kOutside = -1;

/// Where the particles of a block stand in the integers of the kernel. Turns are in units of
/// 1 / kTurn (modulo 2), scales in 1 / kUnitsPerCode.
struct alignas(64) Places {
  std::array<std::int32_t, kBlock> cell;  ///< index, or kOutside
  std::array<std::uint16_t, kBlock> heading;
  std::array<std::int16_t, kBlock> scale;
  std::array<std::uint16_t, kBlock> strain_axis;
  std::array<std::uint16_t, kBlock> strain_level;
};

/// One particle of them.
struct Place {
  const std::int8_t* codes;
  const StrainLevel* strain;
  std::uint16_t heading;
  std::int16_t scale;
  std::uint16_t strain_axis;
};

}  // namespace sketchloc::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace sketchloc::detail::HWY_NAMESPACE {
namespace {

template <class D>
HWY_INLINE auto turn_units(D d, hn::Vec<D> angle_rad, float turns_per_rad) {
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint16_t, D> d16;
  const float units = turns_per_rad * static_cast<float>(BeamGroup::kTurn);
  const auto turn = hn::NearestInt(hn::Mul(angle_rad, hn::Set(d, units)));
  return hn::DemoteTo(d16, hn::And(turn, hn::Set(di, 0xFFFF)));
}

/// Index of the cell under each particle, or kOutside; NaN is in no cell.
template <class D, class V = hn::Vec<D>>
HWY_INLINE auto find_cells(D d, V x, V y, const RangeCodes& table) {
  const hn::RebindToSigned<D> di;
  const V zero = hn::Zero(d);
  const V cells = hn::Set(d, table.cells_per_px);
  const auto in_x = hn::And(hn::Ge(x, zero), hn::Lt(x, hn::Set(d, table.width_px)));
  const auto in_y = hn::And(hn::Ge(y, zero), hn::Lt(y, hn::Set(d, table.height_px)));
  const auto column = hn::Min(hn::ConvertTo(di, hn::Mul(x, cells)), hn::Set(di, table.columns - 1));
  const auto row = hn::Min(hn::ConvertTo(di, hn::Mul(y, cells)), hn::Set(di, table.rows - 1));
  const auto cell = hn::Add(hn::Mul(row, hn::Set(di, table.columns)), column);
  return hn::IfThenElse(hn::RebindMask(di, hn::And(in_x, in_y)), cell, hn::Set(di, kOutside));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE auto is_finite(D d, V value) {
  return hn::RebindMask(hn::RebindToSigned<D>(), hn::Lt(hn::Abs(value), hn::Set(d, 1e30F)));
}

template <class D>
HWY_INLINE void find_places(D d, const ParticleSpans& particles, const float* double_axis_rad,
                            const RangeCodes& table, std::size_t i, Places& places) {
  constexpr auto kTurnsPerRad = static_cast<float>(0.5 / std::numbers::pi);
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::int16_t, D> di16;
  const hn::Rebind<std::uint16_t, D> du16;
  const auto outside = hn::Set(di, kOutside);
  const auto log_scale = hn::LoadU(d, particles.log_scale.data() + i);
  auto cell = find_cells(d, hn::LoadU(d, particles.x_px.data() + i),
                         hn::LoadU(d, particles.y_px.data() + i), table);
  cell = hn::IfThenElse(is_finite(d, log_scale), cell, outside);
  const auto heading = hn::LoadU(d, particles.heading_rad.data() + i);
  hn::StoreU(turn_units(d, heading, kTurnsPerRad), du16, places.heading.data() + i);
  const float scale_units = static_cast<float>(BeamGroup::kUnitsPerCode) / table.log_step;
  const auto scale = hn::NearestInt(hn::Mul(log_scale, hn::Set(d, scale_units)));
  hn::StoreU(hn::DemoteTo(di16, scale), di16, places.scale.data() + i);

  if (particles.strained()) {
    const auto axial = hn::LoadU(d, particles.axial_strain.data() + i);
    const auto diagonal = hn::LoadU(d, particles.diagonal_strain.data() + i);
    const auto size = hn::Sqrt(hn::Add(hn::Mul(axial, axial), hn::Mul(diagonal, diagonal)));
    constexpr auto kLevelsPerStrain = static_cast<float>(1.0 / StrainLevel::kStep);
    const auto level = hn::Min(hn::Mul(size, hn::Set(d, kLevelsPerStrain)),
                               hn::Set(d, static_cast<float>(StrainLevel::kLevels - 1)));
    cell = hn::IfThenElse(is_finite(d, size), cell, outside);
    hn::StoreU(hn::DemoteTo(du16, hn::NearestInt(level)), du16, places.strain_level.data() + i);
    const auto double_axis = hn::LoadU(d, double_axis_rad + i);
    hn::StoreU(turn_units(d, double_axis, 0.5F * kTurnsPerRad), du16,
               places.strain_axis.data() + i);
  }
  hn::StoreU(cell, di, places.cell.data() + i);
}

void find_block(const ParticleSpans& particles, const float* double_axis_rad,
                const RangeCodes& table, Places& places) {
  const hn::ScalableTag<float> d;
  const std::size_t count = particles.size();
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    find_places(d, particles, double_axis_rad, table, i, places);
  }
  for (; i < count; ++i) {
    find_places(hn::CappedTag<float, 1>(), particles, double_axis_rad, table, i, places);
  }
}

#if HWY_TARGET == HWY_SCALAR

using Kernels = const KernelTables&;

/// The sum of kernel integers of one particle, beam by beam: what all vector versions compute.
template <bool kStrained>
std::uint64_t sum_particle(const Place& place, std::span<const BeamGroup> groups,
                           const KernelTables& kernels) {
  const auto add = [](int a, int b) { return std::clamp(a + b, -32768, 32767); };
  const auto bin = [](int turn) { return static_cast<std::size_t>((turn >> 8) & 127); };
  std::uint64_t sum = 0;
  for (const BeamGroup& group : groups) {
    for (std::size_t b = 0; b < BeamGroup::kBeams; ++b) {
      if (group.valid[b] == 0) {
        continue;
      }
      int turn = group.bearing[b % 2][b / 2] + place.heading;
      int code = add(group.range[b % 2][b / 2], place.scale);
      if constexpr (kStrained) {
        const std::size_t from_axis = bin(turn - place.strain_axis);
        turn += 64 * place.strain->turn[from_axis];
        code = add(code, 64 * place.strain->stretch[from_axis]);
      }
      const int expected = place.codes[bin(turn)];
      const int difference = std::clamp((add(code, code) >> 8) - expected, -64, 63);
      const auto index = static_cast<std::size_t>(difference & 127);
      if (group.no_return[b] != 0) {
        sum += kernels.no_return_low[index] + 256U * kernels.no_return_high[index];
      } else if (kernels.has_nothing && expected == 127) {
        sum += kernels.nothing;
      } else {
        sum += kernels.low[index] + 256U * kernels.high[index];
      }
    }
  }
  return sum;
}

#else

using U8 = ByteTable::D;
using I8 = hn::RebindToSigned<U8>;
using U16 = hn::Repartition<std::uint16_t, U8>;
using I16 = hn::RebindToSigned<U16>;
using U64 = hn::Repartition<std::uint64_t, U8>;
using Bytes = hn::Vec<U8>;

struct Kernels {
  ByteTable low;
  ByteTable high;
  ByteTable no_return_low;
  ByteTable no_return_high;
  Bytes nothing_low;
  Bytes nothing_high;
  bool has_nothing;

  HWY_INLINE explicit Kernels(const KernelTables& tables)
      : low(tables.low.data()),
        high(tables.high.data()),
        no_return_low(tables.no_return_low.data()),
        no_return_high(tables.no_return_high.data()),
        nothing_low(hn::Set(U8(), static_cast<std::uint8_t>(tables.nothing & 0xFF))),
        nothing_high(hn::Set(U8(), static_cast<std::uint8_t>(tables.nothing >> 8))),
        has_nothing(tables.has_nothing) {}
};

/// A vector of 16-bit numbers for the even beams and one for the odd ones.
template <class V>
struct Halves {
  V even;
  V odd;
};

/// The high bytes of both, even and odd beams woven together.
template <class V>
HWY_INLINE Bytes weave_high_bytes(const Halves<V>& halves) {
  const auto even = hn::ShiftRight<8>(hn::BitCast(U16(), halves.even));
  return hn::OddEven(hn::BitCast(U8(), halves.odd), hn::BitCast(U8(), even));
}

/// 64 times each signed byte, even and odd beams apart.
HWY_INLINE Halves<hn::Vec<I16>> widen(Bytes bytes) {
  const auto pairs = hn::BitCast(I16(), bytes);
  const auto high_byte = hn::Set(I16(), static_cast<std::int16_t>(-256));
  return {hn::ShiftRight<2>(hn::ShiftLeft<8>(pairs)), hn::ShiftRight<2>(hn::And(pairs, high_byte))};
}

/// The constants of one particle, spread over vectors.
struct Particle {
  ByteTable expected;
  ByteTable strain_turn;
  ByteTable strain_stretch;
  hn::Vec<U16> heading;
  hn::Vec<U16> strain_axis;
  hn::Vec<I16> scale;

  HWY_INLINE explicit Particle(const Place& place)
      : expected(place.codes),
        strain_turn(place.strain->turn.data()),
        strain_stretch(place.strain->stretch.data()),
        heading(hn::Set(U16(), place.heading)),
        strain_axis(hn::Set(U16(), place.strain_axis)),
        scale(hn::Set(I16(), place.scale)) {}
};

struct Codes {
  Bytes measured;
  Bytes expected;
};

/// Codes of one vector of beams, starting at pair `at` of the group.
template <bool kStrained>
HWY_INLINE Codes beam_codes(const Particle& particle, const BeamGroup& group, std::size_t at) {
  const U16 du;
  const I16 di;
  Halves<hn::Vec<U16>> turn{hn::Add(hn::Load(du, group.bearing[0].data() + at), particle.heading),
                            hn::Add(hn::Load(du, group.bearing[1].data() + at), particle.heading)};
  Halves<hn::Vec<I16>> code{
      hn::SaturatedAdd(hn::Load(di, group.range[0].data() + at), particle.scale),
      hn::SaturatedAdd(hn::Load(di, group.range[1].data() + at), particle.scale)};
  if constexpr (kStrained) {
    const Bytes from_axis = weave_high_bytes(Halves<hn::Vec<U16>>{
        hn::Sub(turn.even, particle.strain_axis), hn::Sub(turn.odd, particle.strain_axis)});
    const auto more_turn = widen(particle.strain_turn[from_axis]);
    const auto more_range = widen(particle.strain_stretch[from_axis]);
    turn = {hn::Add(turn.even, hn::BitCast(du, more_turn.even)),
            hn::Add(turn.odd, hn::BitCast(du, more_turn.odd))};
    code = {hn::SaturatedAdd(code.even, more_range.even),
            hn::SaturatedAdd(code.odd, more_range.odd)};
  }
  // Twice the code saturates where its high byte, the code in whole steps, would overflow.
  code = {hn::SaturatedAdd(code.even, code.even), hn::SaturatedAdd(code.odd, code.odd)};
  return {weave_high_bytes(code), particle.expected[weave_high_bytes(turn)]};
}

/// Low and high bytes of the kernel's integers.
struct Integers {
  Bytes low;
  Bytes high;
};

HWY_INLINE Integers look_up(const Codes& codes, const Kernels& kernels, const BeamGroup& group,
                            std::size_t first) {
  const U8 d;
  const I8 ds;
  const auto difference =
      hn::SaturatedSub(hn::BitCast(ds, codes.measured), hn::BitCast(ds, codes.expected));
  const Bytes index = hn::BitCast(
      d, hn::Min(hn::Max(difference, hn::Set(ds, std::int8_t{-64})), hn::Set(ds, std::int8_t{63})));
  Integers found{kernels.low[index], kernels.high[index]};
  if (kernels.has_nothing) {
    const auto nothing = hn::Eq(codes.expected, hn::Set(d, std::uint8_t{127}));
    found = {hn::IfThenElse(nothing, kernels.nothing_low, found.low),
             hn::IfThenElse(nothing, kernels.nothing_high, found.high)};
  }
  if (!group.all_returned) {
    const auto lost = hn::MaskFromVec(hn::Load(d, group.no_return.data() + first));
    found = {hn::IfThenElse(lost, kernels.no_return_low[index], found.low),
             hn::IfThenElse(lost, kernels.no_return_high[index], found.high)};
  }
  if (!group.all_valid) {
    const auto valid = hn::Load(d, group.valid.data() + first);
    found = {hn::And(found.low, valid), hn::And(found.high, valid)};
  }
  return found;
}

template <bool kStrained>
HWY_INLINE std::uint64_t sum_particle(const Place& place, std::span<const BeamGroup> groups,
                                      const Kernels& kernels) {
  const U64 d64;
  const Particle particle(place);
  auto low_sum = hn::Zero(d64);
  auto high_sum = hn::Zero(d64);
  for (const BeamGroup& group : groups) {
    for (std::size_t first = 0; first < BeamGroup::kBeams; first += hn::Lanes(U8())) {
      const Codes codes = beam_codes<kStrained>(particle, group, first / 2);
      const Integers found = look_up(codes, kernels, group, first);
      low_sum = hn::Add(low_sum, hn::SumsOf8(found.low));
      high_sum = hn::Add(high_sum, hn::SumsOf8(found.high));
    }
  }
  return hn::GetLane(hn::SumOfLanes(d64, hn::Add(low_sum, hn::ShiftLeft<8>(high_sum))));
}

#endif

template <bool kStrained>
HWY_INLINE void sum_all(const Places& places, const BeamTables& tables,
                        std::span<const BeamGroup> groups, const ScoreScale& scale,
                        std::span<float> log_likelihood) {
  const Kernels kernels(*tables.kernels);
  // Places are random, so the lines of the table come from memory: ask for them ahead of time.
  constexpr std::size_t kAhead = 12;
  const std::size_t last = log_likelihood.size() - 1;
  const auto codes_at = [&](std::size_t i) {
    return tables.range.codes + std::ptrdiff_t{std::max(places.cell[i], 0)} * 128;
  };
  for (std::size_t i = 0; i <= last; ++i) {
    const std::int8_t* soon = codes_at(std::min(i + kAhead, last));
    hwy::Prefetch(soon);
    hwy::Prefetch(soon + 64);
    const Place place{.codes = codes_at(i),
                      .strain = tables.strain + (kStrained ? places.strain_level[i] : 0),
                      .heading = places.heading[i],
                      .scale = places.scale[i],
                      .strain_axis = places.strain_axis[i]};
    const std::uint64_t sum =
        places.cell[i] == kOutside ? 0 : sum_particle<kStrained>(place, groups, kernels);
    log_likelihood[i] = static_cast<float>(scale.least + static_cast<double>(sum) * scale.unit);
  }
}

void sum_block(const Places& places, bool strained, const BeamTables& tables,
               std::span<const BeamGroup> groups, const ScoreScale& scale,
               std::span<float> log_likelihood) {
  if (strained) {
    sum_all<true>(places, tables, groups, scale, log_likelihood);
  } else {
    sum_all<false>(places, tables, groups, scale, log_likelihood);
  }
}

}  // namespace
}  // namespace sketchloc::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc::detail {

HWY_EXPORT(find_block);
HWY_EXPORT(sum_block);

void score_beams(const ParticleSpans& particles, const BeamTables& tables,
                 std::span<const BeamGroup> groups, const ScoreScale& scale,
                 std::span<float> log_likelihood) {
  Places places{};
  alignas(64) std::array<float, kBlock> double_axis_rad;
  for (std::size_t from = 0; from < particles.size(); from += kBlock) {
    const std::size_t count = std::min(kBlock, particles.size() - from);
    const ParticleSpans block = particles.subspan(from, count);
    if (block.strained()) {
      angles(block.axial_strain, block.diagonal_strain, std::span(double_axis_rad).first(count));
    }
    HWY_DYNAMIC_DISPATCH(find_block)(block, double_axis_rad.data(), tables.range, places);
    HWY_DYNAMIC_DISPATCH(sum_block)
    (places, block.strained(), tables, groups, scale, log_likelihood.subspan(from, count));
  }
}

}  // namespace sketchloc::detail
#endif

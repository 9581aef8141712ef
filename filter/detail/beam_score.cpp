#include "filter/detail/beam_score.hpp"

#include <algorithm>
#include <numbers>

#include "registration/vector_math.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter/detail/beam_score.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

// Shared by all instruction sets.
#ifndef SKETCHLOC_FILTER_BEAM_SCORE_ONCE
#define SKETCHLOC_FILTER_BEAM_SCORE_ONCE
namespace sketchloc::detail {

constexpr std::size_t kBlock = 256;  ///< particles whose places are found together
constexpr std::size_t kHeadings = 128;
constexpr std::int32_t kOutside = -1;

/// Where the particles of a block stand in the integers of the kernel.
struct Places {
  alignas(64) std::array<std::int32_t, kBlock> cell;  ///< index, or kOutside
  alignas(64) std::array<std::uint16_t, kBlock> heading;
  alignas(64) std::array<std::int16_t, kBlock> scale;
};

}  // namespace sketchloc::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace sketchloc::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE void find_places(D d, const ParticleView& particles, const float* log_scale,
                            const RangeCodes& table, std::size_t from, std::size_t i,
                            Places& places) {
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint16_t, D> du16;
  const hn::Rebind<std::int16_t, D> di16;
  const auto number = [d](float value) HWY_ATTR { return hn::Set(d, value); };
  const auto zero = hn::Zero(d);
  const auto x = hn::LoadU(d, particles.x_px.data() + from + i);
  const auto y = hn::LoadU(d, particles.y_px.data() + from + i);
  const auto scale = hn::LoadU(d, particles.scale_px_per_m.data() + from + i);
  const auto in_x = hn::And(hn::Ge(x, zero), hn::Lt(x, number(table.width_px)));
  const auto in_y = hn::And(hn::Ge(y, zero), hn::Lt(y, number(table.height_px)));
  const auto usable = hn::And(hn::Ge(scale, number(1e-30F)), hn::Le(scale, number(1e30F)));
  const auto inside = hn::RebindMask(di, hn::And(usable, hn::And(in_x, in_y)));
  const auto cells = number(table.cells_per_px);
  const auto column = hn::Min(hn::ConvertTo(di, hn::Mul(x, cells)), hn::Set(di, table.columns - 1));
  const auto row = hn::Min(hn::ConvertTo(di, hn::Mul(y, cells)), hn::Set(di, table.rows - 1));
  const auto cell = hn::Add(hn::Mul(row, hn::Set(di, table.columns)), column);
  hn::StoreU(hn::IfThenElse(inside, cell, hn::Set(di, kOutside)), di, places.cell.data() + i);

  const float turn_units = static_cast<float>(BeamGroup::kTurn / (2.0 * std::numbers::pi));
  const auto heading = hn::NearestInt(
      hn::Mul(hn::LoadU(d, particles.heading_rad.data() + from + i), number(turn_units)));
  const auto low_bits = hn::And(heading, hn::Set(di, 0xFFFF));
  hn::StoreU(hn::DemoteTo(du16, low_bits), du16, places.heading.data() + i);

  const float scale_units = static_cast<float>(BeamGroup::kUnitsPerCode) / table.log_step;
  const auto scale_code = hn::NearestInt(hn::Mul(hn::LoadU(d, log_scale + i), number(scale_units)));
  hn::StoreU(hn::DemoteTo(di16, scale_code), di16, places.scale.data() + i);
}

void find_block(const ParticleView& particles, const float* log_scale, const RangeCodes& table,
                std::size_t from, std::size_t count, Places& places) {
  const hn::ScalableTag<float> d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    find_places(d, particles, log_scale, table, from, i, places);
  }
  for (; i < count; ++i) {
    find_places(hn::CappedTag<float, 1>(), particles, log_scale, table, from, i, places);
  }
}

#if HWY_TARGET == HWY_SCALAR

/// The sum of kernel integers of one particle: the reference for all vector versions.
std::uint64_t sum_particle(const std::int8_t* codes, std::uint16_t heading, std::int16_t scale,
                           std::span<const BeamGroup> groups, const KernelTables& kernels) {
  std::uint64_t sum = 0;
  for (const BeamGroup& group : groups) {
    for (std::size_t b = 0; b < BeamGroup::kBeams; ++b) {
      if (group.valid[b] == 0) {
        continue;
      }
      const auto turned = static_cast<std::uint16_t>(group.bearing[b % 2][b / 2] + heading);
      const int expected = codes[(turned >> 8) % kHeadings];
      const int at_scale = std::clamp(group.range[b % 2][b / 2] + scale, -32768, 32767);
      const int measured = std::clamp(2 * at_scale, -32768, 32767) >> 8;
      const int difference = std::clamp(measured - expected, -64, 63);
      const auto index = static_cast<std::size_t>(difference & 127);
      const bool lost = group.no_return[b] != 0;
      sum += lost ? kernels.no_return_low[index] + 256U * kernels.no_return_high[index]
                  : kernels.low[index] + 256U * kernels.high[index];
    }
  }
  return sum;
}

#else

/// A table of 128 bytes for look-ups by indices of 7 bits.
template <class D>
class ByteTable {
 public:
  template <class T>
  HWY_INLINE ByteTable(D d, const T* bytes) {
    static_assert(sizeof(T) == 1);
    for (std::size_t part = 0; part < kParts; ++part) {
      parts_[part] =
#if HWY_TARGET == HWY_AVX3_DL
          hn::Load(d, reinterpret_cast<const std::uint8_t*>(bytes) + 64 * part);
#else
          hn::LoadDup128(d, reinterpret_cast<const std::uint8_t*>(bytes) + 16 * part);
#endif
    }
  }

  /// Byte by byte table[index % 128] (with VBMI) or table[index] (index < 128 everywhere else).
  HWY_INLINE hn::Vec<D> operator[](hn::Vec<D> index) const {
#if HWY_TARGET == HWY_AVX3_DL
    return hn::Vec<D>{_mm512_permutex2var_epi8(parts_[0].raw, index.raw, parts_[1].raw)};
#else
    const D d;
    const hn::RebindToSigned<D> ds;
    auto found = hn::Zero(d);
    for (std::size_t part = 0; part < kParts; ++part) {
      const auto within =
          hn::Sub(hn::BitCast(ds, index), hn::Set(ds, static_cast<std::int8_t>(16 * part)));
      // Negative indices look up 0 by themselves, those above 15 have to be made negative.
      const auto beyond = hn::VecFromMask(ds, hn::Gt(within, hn::Set(ds, std::int8_t{15})));
      found = hn::Or(found,
                     hn::TableLookupBytesOr0(parts_[part], hn::BitCast(d, hn::Or(within, beyond))));
    }
    return found;
#endif
  }

 private:
  static constexpr std::size_t kParts = HWY_TARGET == HWY_AVX3_DL ? 2 : 8;
  hn::Vec<D> parts_[kParts];
};

/// All four tables of the kernels, in registers where there are enough of them.
template <class D>
struct Kernels {
  ByteTable<D> low;
  ByteTable<D> high;
  ByteTable<D> no_return_low;
  ByteTable<D> no_return_high;

  Kernels(D d, const KernelTables& tables)
      : low(d, tables.low.data()),
        high(d, tables.high.data()),
        no_return_low(d, tables.no_return_low.data()),
        no_return_high(d, tables.no_return_high.data()) {}
};

using U8 = hn::ScalableTag<std::uint8_t>;
using I8 = hn::RebindToSigned<U8>;
using U16 = hn::Repartition<std::uint16_t, U8>;
using I16 = hn::RebindToSigned<U16>;
using U64 = hn::Repartition<std::uint64_t, U8>;

/// High bytes of two vectors of 16-bit numbers, woven: even bytes from `even`, odd from `odd`.
template <class V>
HWY_INLINE hn::Vec<U8> weave_high_bytes(V even, V odd) {
  const U8 d8;
  const U16 d16;
  return hn::OddEven(hn::BitCast(d8, odd),
                     hn::BitCast(d8, hn::ShiftRight<8>(hn::BitCast(d16, even))));
}

/// One vector of beams of one particle: indices into the kernel tables.
HWY_INLINE hn::Vec<U8> differences(const ByteTable<U8>& expected, const BeamGroup& group,
                                   std::size_t at, hn::Vec<U16> heading, hn::Vec<I16> scale) {
  const U8 d8;
  const I8 di8;
  const U16 d16;
  const I16 di16;
  const auto turned = [&](std::size_t odd) HWY_ATTR {
    return hn::Add(hn::Load(d16, group.bearing[odd].data() + at), heading);
  };
  const auto measured = [&](std::size_t odd) HWY_ATTR {
    const auto code = hn::SaturatedAdd(hn::Load(di16, group.range[odd].data() + at), scale);
    return hn::SaturatedAdd(code, code);
  };
  auto index = weave_high_bytes(turned(0), turned(1));
#if HWY_TARGET != HWY_AVX3_DL
  index = hn::And(index, hn::Set(d8, std::uint8_t{127}));
#endif
  const auto difference =
      hn::SaturatedSub(hn::BitCast(di8, weave_high_bytes(measured(0), measured(1))),
                       hn::BitCast(di8, expected[index]));
  const auto clamped =
      hn::Min(hn::Max(difference, hn::Set(di8, std::int8_t{-64})), hn::Set(di8, std::int8_t{63}));
  const auto result = hn::BitCast(d8, clamped);
#if HWY_TARGET == HWY_AVX3_DL
  return result;
#else
  return hn::And(result, hn::Set(d8, std::uint8_t{127}));
#endif
}

std::uint64_t sum_particle(const std::int8_t* codes, std::uint16_t heading, std::int16_t scale,
                           std::span<const BeamGroup> groups, const Kernels<U8>& kernels) {
  const U8 d8;
  const U64 d64;
  const ByteTable<U8> expected(d8, codes);
  const auto headings = hn::Set(U16(), heading);
  const auto scales = hn::Set(I16(), scale);
  auto low_sum = hn::Zero(d64);
  auto high_sum = hn::Zero(d64);
  for (const BeamGroup& group : groups) {
    for (std::size_t b = 0; b < BeamGroup::kBeams; b += hn::Lanes(d8)) {
      const auto index = differences(expected, group, b / 2, headings, scales);
      auto low = kernels.low[index];
      auto high = kernels.high[index];
      if (!group.all_returned) {
        const auto lost = hn::MaskFromVec(hn::Load(d8, group.no_return.data() + b));
        low = hn::IfThenElse(lost, kernels.no_return_low[index], low);
        high = hn::IfThenElse(lost, kernels.no_return_high[index], high);
      }
      if (!group.all_valid) {
        const auto valid = hn::Load(d8, group.valid.data() + b);
        low = hn::And(low, valid);
        high = hn::And(high, valid);
      }
      low_sum = hn::Add(low_sum, hn::SumsOf8(low));
      high_sum = hn::Add(high_sum, hn::SumsOf8(high));
    }
  }
  return hn::GetLane(hn::SumOfLanes(d64, hn::Add(low_sum, hn::ShiftLeft<8>(high_sum))));
}

#endif

void sum_block(const Places& places, std::size_t count, const std::int8_t* codes,
               const KernelTables& tables, std::span<const BeamGroup> groups,
               const ScoreScale& scale, float* log_likelihood) {
#if HWY_TARGET == HWY_SCALAR
  const KernelTables& kernels = tables;
#else
  const Kernels<U8> kernels(U8(), tables);
#endif
  // Places are random, so the lines of the table come from memory: ask for them ahead of time.
  constexpr std::size_t kAhead = 12;
  const auto row_of = [codes](std::int32_t cell) {
    return codes + static_cast<std::ptrdiff_t>(std::max(cell, 0)) * std::ptrdiff_t{kHeadings};
  };
  for (std::size_t i = 0; i < count; ++i) {
    const std::int8_t* soon = row_of(places.cell[std::min(i + kAhead, count - 1)]);
    hwy::Prefetch(soon);
    hwy::Prefetch(soon + 64);
    const std::uint64_t sum = places.cell[i] == kOutside
                                  ? 0
                                  : sum_particle(row_of(places.cell[i]), places.heading[i],
                                                 places.scale[i], groups, kernels);
    log_likelihood[i] = static_cast<float>(scale.least + static_cast<double>(sum) * scale.unit);
  }
}

}  // namespace
}  // namespace sketchloc::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc::detail {

HWY_EXPORT(find_block);
HWY_EXPORT(sum_block);

void score_beams(const ParticleView& particles, const RangeCodes& table,
                 const KernelTables& kernels, std::span<const BeamGroup> groups,
                 const ScoreScale& scale, std::span<float> log_likelihood) {
  Places places;
  std::array<float, kBlock> log_scale;
  for (std::size_t from = 0; from < particles.size(); from += kBlock) {
    const std::size_t count = std::min(kBlock, particles.size() - from);
    logarithms(particles.scale_px_per_m.subspan(from, count), std::span(log_scale).first(count));
    HWY_DYNAMIC_DISPATCH(find_block)(particles, log_scale.data(), table, from, count, places);
    HWY_DYNAMIC_DISPATCH(sum_block)
    (places, count, table.codes, kernels, groups, scale, log_likelihood.data() + from);
  }
}

}  // namespace sketchloc::detail
#endif

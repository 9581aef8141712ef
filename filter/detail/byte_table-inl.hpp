// Look-ups in tables of 128 bytes; included once per instruction set (see hwy/foreach_target.h).
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#if defined(SKETCHLOC_FILTER_BYTE_TABLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SKETCHLOC_FILTER_BYTE_TABLE_INL
#undef SKETCHLOC_FILTER_BYTE_TABLE_INL
#else
#define SKETCHLOC_FILTER_BYTE_TABLE_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace sketchloc::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

/// A table of 128 bytes, 64-byte aligned, held in registers where there are enough of them. With
/// AVX-512 VBMI a vector of 64 look-ups is one instruction, everywhere else eight shuffles.
class ByteTable {
 public:
  using D = hn::ScalableTag<std::uint8_t>;
  using V = hn::Vec<D>;

  template <class T>
  HWY_INLINE explicit ByteTable(const T* bytes) {
    static_assert(sizeof(T) == 1);
    const auto* from = reinterpret_cast<const std::uint8_t*>(bytes);
    for (std::size_t part = 0; part < kParts; ++part) {
#if HWY_TARGET == HWY_AVX3_DL
      parts_[part] = hn::Load(D(), from + 64 * part);
#else
      parts_[part] = hn::LoadDup128(D(), from + 16 * part);
#endif
    }
  }

  /// Byte by byte, table[index % 128].
  HWY_INLINE V operator[](V index) const {
#if HWY_TARGET == HWY_AVX3_DL
    return V{_mm512_permutex2var_epi8(parts_[0].raw, index.raw, parts_[1].raw)};
#else
    const D d;
    const hn::RebindToSigned<D> ds;
    const auto wrapped = hn::BitCast(ds, hn::And(index, hn::Set(d, std::uint8_t{127})));
    V found = hn::Zero(d);
    for (std::size_t part = 0; part < kParts; ++part) {
      const auto within = hn::Sub(wrapped, hn::Set(ds, static_cast<std::int8_t>(16 * part)));
      // Negative indices look up 0 by themselves, those above 15 have to be made negative.
      const auto beyond = hn::VecFromMask(ds, hn::Gt(within, hn::Set(ds, std::int8_t{15})));
      const V here = hn::BitCast(d, hn::Or(within, beyond));
      found = hn::Or(found, hn::TableLookupBytesOr0(parts_[part], here));
    }
    return found;
#endif
  }

 private:
  static constexpr std::size_t kParts = HWY_TARGET == HWY_AVX3_DL ? 2 : 8;
  V parts_[kParts];
};

#endif

}  // namespace sketchloc::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

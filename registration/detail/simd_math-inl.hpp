// Vector mathematics for kernels; included once per instruction set (see hwy/foreach_target.h).
// Only plain multiplications and additions, so that every instruction set gives the same bits.
#include <hwy/highway.h>

#if defined(SKETCHLOC_REGISTRATION_SIMD_MATH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SKETCHLOC_REGISTRATION_SIMD_MATH_INL
#undef SKETCHLOC_REGISTRATION_SIMD_MATH_INL
#else
#define SKETCHLOC_REGISTRATION_SIMD_MATH_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace sketchloc::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct UnitVector {
  V cosine;
  V sine;
};

/// Cosine and sine by reduction to [-pi/4, pi/4] and minimax polynomials (ours, by Remez exchange:
/// maximal errors 1.8e-9 and 1e-10 before rounding).
template <class D, class V = hn::Vec<D>>
HWY_INLINE UnitVector<V> unit_vector(D d, V heading_rad) {
  const hn::RebindToSigned<D> di;
  const auto number = [d](float value) { return hn::Set(d, value); };

  // heading = quarter * pi/2 + x; pi/2 in three parts whose products with `quarter` are exact.
  const V quarter = hn::Round(hn::Mul(heading_rad, number(0.636619772F)));
  V x = hn::Sub(heading_rad, hn::Mul(quarter, number(1.5703125F)));
  x = hn::Sub(x, hn::Mul(quarter, number(4.837512969970703e-4F)));
  x = hn::Sub(x, hn::Mul(quarter, number(7.549790e-8F)));
  const V z = hn::Mul(x, x);

  V s = hn::Add(hn::Mul(number(-1.9495293e-4F), z), number(8.3319760e-3F));
  s = hn::Add(hn::Mul(s, z), number(-1.66666506e-1F));
  s = hn::Add(x, hn::Mul(hn::Mul(s, z), x));

  V c = hn::Add(hn::Mul(number(2.4438091e-5F), z), number(-1.38873645e-3F));
  c = hn::Add(hn::Mul(c, z), number(4.16666468e-2F));
  c = hn::Add(hn::Sub(number(1.0F), hn::Mul(z, number(0.5F))), hn::Mul(hn::Mul(c, z), z));

  const auto turn = hn::ConvertTo(di, quarter);
  const auto has_bit = [di](auto value, int bit) { return hn::TestBit(value, hn::Set(di, bit)); };
  const auto odd = hn::RebindMask(d, has_bit(turn, 1));
  const auto sine_negative = hn::RebindMask(d, has_bit(turn, 2));
  const auto cosine_negative = hn::RebindMask(d, has_bit(hn::Add(turn, hn::Set(di, 1)), 2));
  const V cosine = hn::IfThenElse(odd, s, c);
  const V sine = hn::IfThenElse(odd, c, s);
  return {hn::IfThenElse(cosine_negative, hn::Neg(cosine), cosine),
          hn::IfThenElse(sine_negative, hn::Neg(sine), sine)};
}

}  // namespace sketchloc::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

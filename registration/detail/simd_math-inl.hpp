// Vector mathematics for kernels; included once per instruction set (see hwy/foreach_target.h).
// Only plain multiplications and additions, so that every instruction set gives the same bits.
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

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

/// Natural logarithm of positive normal numbers: m 2^k with m in [sqrt(1/2), sqrt(2)), then a
/// minimax polynomial in m - 1 (ours, maximal error 4e-8 before rounding).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V logarithm(D d, V positive) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, positive);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3F3504F3)));
  const V k = hn::ConvertTo(d, exponent);
  const V mantissa = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const V t = hn::Sub(mantissa, hn::Set(d, 1.0F));
  constexpr float kCoefficients[] = {1.63361126e-1F,  -1.73261702e-1F, 1.98882273e-1F,
                                     -2.49614468e-1F, 3.33352627e-1F,  -5.00005848e-1F};
  V p = hn::Set(d, -1.00346447e-1F);
  for (const float coefficient : kCoefficients) {
    p = hn::Add(hn::Mul(p, t), hn::Set(d, coefficient));
  }
  // ln 2 in two parts; the product of the first with k is exact.
  const V low = hn::Add(hn::Mul(hn::Mul(t, t), p), hn::Mul(k, hn::Set(d, 1.42860677e-6F)));
  return hn::Add(hn::Mul(k, hn::Set(d, 0.693145752F)), hn::Add(t, low));
}

/// exp(clamp(exponent, -80, 80)): 2^k exp(x) with |x| <= ln 2 / 2 and the series of exp to x^7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exponential(D d, V exponent) {
  const hn::RebindToSigned<D> di;
  const auto number = [d](float value) HWY_ATTR { return hn::Set(d, value); };
  const V clamped = hn::Min(hn::Max(exponent, number(-80.0F)), number(80.0F));
  const V k = hn::Round(hn::Mul(clamped, number(1.44269504F)));
  // ln 2 in two parts; the product of the first with k is exact.
  V x = hn::Sub(clamped, hn::Mul(k, number(0.693145752F)));
  x = hn::Sub(x, hn::Mul(k, number(1.42860677e-6F)));
  constexpr float kCoefficients[] = {1.0F / 720, 1.0F / 120, 1.0F / 24, 1.0F / 6, 0.5F, 1.0F, 1.0F};
  V p = number(1.0F / 5040);
  for (const float coefficient : kCoefficients) {
    p = hn::Add(hn::Mul(p, x), number(coefficient));
  }
  const auto power = hn::Add(hn::ConvertTo(di, k), hn::Set(di, 127));
  return hn::Mul(p, hn::BitCast(d, hn::ShiftLeft<23>(power)));
}

/// Angle of the vector (x, y): minimax polynomial (ours, maximal error 4e-7) in the ratio of the
/// smaller to the larger coordinate, then mirrored into the right octant.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V angle(D d, V x, V y) {
  const auto number = [d](float value) HWY_ATTR { return hn::Set(d, value); };
  const V wide = hn::Abs(x);
  const V high = hn::Abs(y);
  const V larger = hn::Max(hn::Max(wide, high), number(1e-30F));
  const V ratio = hn::Div(hn::Min(wide, high), larger);
  const V z = hn::Mul(ratio, ratio);
  constexpr float kCoefficients[] = {-3.55199324e-2F, 8.21678193e-2F, -1.33988027e-1F,
                                     1.98618565e-1F, -3.33253948e-1F};
  V p = number(7.37400250e-3F);
  for (const float coefficient : kCoefficients) {
    p = hn::Add(hn::Mul(p, z), number(coefficient));
  }
  V angle = hn::Add(ratio, hn::Mul(hn::Mul(p, z), ratio));
  angle = hn::IfThenElse(hn::Gt(high, wide), hn::Sub(number(1.57079633F), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(number(3.14159265F), angle), angle);
  return hn::IfThenElse(hn::Lt(y, hn::Zero(d)), hn::Neg(angle), angle);
}

/// Calls some_at(d, i) for all i in [0, count) in whole vectors, then one by one.
template <class Function>
HWY_INLINE void for_each_vector(std::size_t count, const Function& some_at) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    some_at(d, i);
  }
  for (; i < count; ++i) {
    some_at(hn::CappedTag<float, 1>(), i);
  }
}

}  // namespace sketchloc::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

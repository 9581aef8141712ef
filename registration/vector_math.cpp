#include "registration/vector_math.hpp"

#include <cstddef>

#include "motion/check.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/vector_math.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "registration/detail/simd_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sketchloc::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = detail::HWY_NAMESPACE;

void fill_unit_vectors(const float* heading_rad, std::size_t count, float* cosine, float* sine) {
  const auto some_at = [=](auto d, std::size_t i) {
    const auto unit = simd::unit_vector(d, hn::LoadU(d, heading_rad + i));
    hn::StoreU(unit.cosine, d, cosine + i);
    hn::StoreU(unit.sine, d, sine + i);
  };
  simd::for_each_vector(count, some_at);
}

void fill_logarithms(const float* positive, std::size_t count, float* logarithm) {
  const auto some_at = [=](auto d, std::size_t i) {
    hn::StoreU(simd::logarithm(d, hn::LoadU(d, positive + i)), d, logarithm + i);
  };
  simd::for_each_vector(count, some_at);
}

void fill_exponentials(const float* exponent, std::size_t count, float* exponential) {
  const auto some_at = [=](auto d, std::size_t i) {
    hn::StoreU(simd::exponential(d, hn::LoadU(d, exponent + i)), d, exponential + i);
  };
  simd::for_each_vector(count, some_at);
}

void fill_angles(const float* x, const float* y, std::size_t count, float* angle_rad) {
  const auto some_at = [=](auto d, std::size_t i) {
    hn::StoreU(simd::angle(d, hn::LoadU(d, x + i), hn::LoadU(d, y + i)), d, angle_rad + i);
  };
  simd::for_each_vector(count, some_at);
}

}  // namespace
}  // namespace sketchloc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc {

HWY_EXPORT(fill_unit_vectors);
HWY_EXPORT(fill_logarithms);
HWY_EXPORT(fill_exponentials);
HWY_EXPORT(fill_angles);

void unit_vectors(std::span<const float> heading_rad, std::span<float> cosine,
                  std::span<float> sine) {
  check(cosine.size() == heading_rad.size() && sine.size() == heading_rad.size(),
        "one cosine and one sine per heading");
  HWY_DYNAMIC_DISPATCH(fill_unit_vectors)
  (heading_rad.data(), heading_rad.size(), cosine.data(), sine.data());
}

void logarithms(std::span<const float> positive, std::span<float> logarithm) {
  check(logarithm.size() == positive.size(), "one logarithm per number");
  HWY_DYNAMIC_DISPATCH(fill_logarithms)(positive.data(), positive.size(), logarithm.data());
}

void exponentials(std::span<const float> exponent, std::span<float> exponential) {
  check(exponential.size() == exponent.size(), "one exponential per exponent");
  HWY_DYNAMIC_DISPATCH(fill_exponentials)(exponent.data(), exponent.size(), exponential.data());
}

void angles(std::span<const float> x, std::span<const float> y, std::span<float> angle_rad) {
  check(y.size() == x.size() && angle_rad.size() == x.size(), "one angle per vector");
  HWY_DYNAMIC_DISPATCH(fill_angles)(x.data(), y.data(), x.size(), angle_rad.data());
}

}  // namespace sketchloc
#endif

#include "registration/unit_vectors.hpp"

#include <cstddef>

#include "motion/check.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/unit_vectors.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "registration/detail/simd_math-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sketchloc::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void fill_unit_vectors(const float* heading_rad, std::size_t count, float* cosine, float* sine) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    const auto unit = detail::HWY_NAMESPACE::unit_vector(d, hn::LoadU(d, heading_rad + i));
    hn::StoreU(unit.cosine, d, cosine + i);
    hn::StoreU(unit.sine, d, sine + i);
  }
  const hn::CappedTag<float, 1> one;
  for (; i < count; ++i) {
    const auto unit = detail::HWY_NAMESPACE::unit_vector(one, hn::LoadU(one, heading_rad + i));
    hn::StoreU(unit.cosine, one, cosine + i);
    hn::StoreU(unit.sine, one, sine + i);
  }
}

}  // namespace
}  // namespace sketchloc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc {

HWY_EXPORT(fill_unit_vectors);

void unit_vectors(std::span<const float> heading_rad, std::span<float> cosine,
                  std::span<float> sine) {
  check(cosine.size() == heading_rad.size() && sine.size() == heading_rad.size(),
        "one cosine and one sine per heading");
  HWY_DYNAMIC_DISPATCH(fill_unit_vectors)
  (heading_rad.data(), heading_rad.size(), cosine.data(), sine.data());
}

}  // namespace sketchloc
#endif

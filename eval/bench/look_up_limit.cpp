#include "eval/bench/look_up_limit.hpp"

#include <array>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "eval/bench/look_up_limit.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sketchloc::bench::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

std::uint32_t gather_all(const std::uint32_t* cells, const std::int32_t* index, std::size_t count) {
  const hn::ScalableTag<std::uint32_t> du;
  const hn::ScalableTag<std::int32_t> di;
  auto sum = hn::Zero(du);
  for (std::size_t i = 0; i + hn::Lanes(du) <= count; i += hn::Lanes(du)) {
    sum = hn::Add(sum, hn::GatherIndex(du, cells, hn::LoadU(di, index + i)));
  }
  return hn::GetLane(hn::SumOfLanes(du, sum));
}

}  // namespace
}  // namespace sketchloc::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc::bench {

HWY_EXPORT(gather_all);

std::uint32_t sum_by_gather(const std::uint32_t* cells, std::span<const std::int32_t> index) {
  return HWY_DYNAMIC_DISPATCH(gather_all)(cells, index.data(), index.size());
}

std::uint32_t sum_by_loads(const std::uint16_t* cells, std::span<const std::int32_t> index) {
  std::array<std::uint32_t, 4> sums{};
  for (std::size_t i = 0; i + 4 <= index.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      sums[k] += cells[index[i + k]];
    }
  }
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace sketchloc::bench
#endif

#pragma once

#include <cstdint>
#include <span>

namespace sketchloc::bench {

/// The sum of the cells at ready-made indices by the processor's gather instruction: what a look-up
/// kernel built on it could reach at best.
std::uint32_t sum_by_gather(const std::uint32_t* cells, std::span<const std::int32_t> index);

/// The same by one load per index, from 16-bit cells.
std::uint32_t sum_by_loads(const std::uint16_t* cells, std::span<const std::int32_t> index);

}  // namespace sketchloc::bench

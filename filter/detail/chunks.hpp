#pragma once

#include <algorithm>
#include <cstddef>

#include "filter/predict.hpp"

namespace sketchloc {

/// Particles per chunk: each chunk has an engine of its own, so that the result does not depend on
/// how many threads share the chunks.
constexpr std::size_t kChunk = 256;

/// Calls work(chunk, range) for all chunks of `count` particles on up to `jobs` threads.
template <typename Work>
void for_each_chunk(std::size_t count, int jobs, Work&& work) {
  const auto chunks = static_cast<std::ptrdiff_t>((count + kChunk - 1) / kChunk);
#pragma omp parallel for schedule(static) num_threads(jobs) if (jobs > 1)
  for (std::ptrdiff_t chunk = 0; chunk < chunks; ++chunk) {
    const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
    work(static_cast<std::size_t>(chunk),
         ParticleRange{.begin = begin, .end = std::min(begin + kChunk, count)});
  }
}

}  // namespace sketchloc

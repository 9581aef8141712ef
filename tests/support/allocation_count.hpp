#pragma once

#include <cstddef>

namespace sketchloc::testing {

/// How often operator new was called so far, by any thread. Link allocation_count.cpp to count.
std::size_t allocation_count();

}  // namespace sketchloc::testing

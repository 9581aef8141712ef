#include "apps/memory.hpp"

#include <sys/resource.h>

namespace sketchloc {

double peak_memory_mb() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr double kKibibyte_mb = 1024.0 / 1e6;  // Linux counts in KiB
  return static_cast<double>(usage.ru_maxrss) * kKibibyte_mb;
}

}  // namespace sketchloc

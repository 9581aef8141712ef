#pragma once

namespace sketchloc {

/// Peak resident set of this process so far; 1 MB = 10^6 bytes.
double peak_memory_mb();

}  // namespace sketchloc

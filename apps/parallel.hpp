#pragma once

#include <cstddef>
#include <functional>

namespace sketchloc {

/// How many threads are meant by `jobs`: 0 is one per core.
unsigned thread_count(unsigned jobs);

/// Does work(0) ... work(count - 1) on up to `jobs` threads (0: one per core), in any order, and
/// calls done(n) on this thread as pieces are finished. The first exception, of the work or of
/// done, ends all and is thrown here.
void work_in_parallel(std::size_t count, unsigned jobs,
                      const std::function<void(std::size_t)>& work,
                      const std::function<void(std::size_t)>& done);

}  // namespace sketchloc

#include "apps/ranks.hpp"

#include <algorithm>
#include <cstdlib>

namespace sketchloc {

Hire hire_here(const TextWork& work) {
  return [&work]() -> Worker {
    return [&work, worker = work.hire()](std::size_t i) {
      const std::size_t piece = work.pieces.at(i);
      work.keep(piece, worker(piece));
    };
  };
}

int processes_started() {
  int most = 1;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {  // Open MPI; MPICH and others
    if (const char* count = std::getenv(name)) {
      most = std::max(most, std::atoi(count));
    }
  }
  return most;
}

}  // namespace sketchloc

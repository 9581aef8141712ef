#include <stdexcept>

#include "apps/ranks.hpp"
#include "motion/check.hpp"

namespace sketchloc {

class Ranks::Link {};

Ranks::Ranks() {
  if (processes_started() > 1) {
    throw std::runtime_error(
        "this program was built without MPI; build it with SKETCHLOC_MPI, as ./dev build mpi does, "
        "or leave out mpirun");
  }
}

Ranks::~Ranks() = default;

bool Ranks::leads() const { return true; }

void Ranks::lead(const TextWork& work, unsigned jobs,
                 const std::function<void(std::size_t)>& done) {
  PieceQueue queue(work.pieces.size());
  work_through(queue, jobs, hire_here(work), done);
}

void Ranks::follow(const TextWork& /*work*/, unsigned /*jobs*/) { check(false, "alone"); }

void Ranks::fail(const std::string& /*why*/) { check(false, "alone"); }

}  // namespace sketchloc

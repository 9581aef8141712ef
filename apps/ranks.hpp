#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/parallel.hpp"

namespace sketchloc {

/// Pieces of work whose results are texts.
struct TextWork {
  std::string what;                 ///< all that the results depend on, the same in every process
  std::vector<std::size_t> pieces;  ///< that the first process wants
  /// Called on each thread that works: what it does with a piece. Need not be safe to share.
  std::function<std::function<std::string(std::size_t)>()> hire;
  /// Takes the result of a piece, in the first process; from many threads at once.
  std::function<void(std::size_t, const std::string&)> keep;
};

/// The processes that mpirun started, which share work: the first one leads, hands out the pieces
/// and takes the results, and works too. Without mpirun it is alone.
class Ranks {
 public:
  /// Throws std::runtime_error where mpirun started several and the program was built without MPI.
  Ranks();
  ~Ranks();  ///< waits for the others
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  bool leads() const;

  /// The first process: has all pieces done on `jobs` threads of each process (0: one per core) and
  /// calls done(n) on this thread as they are. Throws what fails here, and std::runtime_error where
  /// another process fails or is about other work; what was kept by then stays kept.
  void lead(const TextWork& work, unsigned jobs, const std::function<void(std::size_t)>& done);

  /// The others: work until the first one has nothing left.
  void follow(const TextWork& work, unsigned jobs);

  /// The others: tells the first one what went wrong here, which ends all.
  void fail(const std::string& why);

 private:
  class Link;
  std::unique_ptr<Link> link_;
};

/// Workers of the first process: they keep what they make.
Hire hire_here(const TextWork& work);

/// How many processes mpirun started; 1 without it.
int processes_started();

}  // namespace sketchloc

#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>

namespace sketchloc {

/// How many threads are meant by `jobs`: 0 is one per core.
unsigned thread_count(unsigned jobs);

/// Pieces 0 ... count - 1 of some work, handed out one by one to whoever asks. Safe to use from
/// many threads.
class PieceQueue {
 public:
  explicit PieceQueue(std::size_t count) : count_(count) {}
  std::size_t count() const { return count_; }

  std::optional<std::size_t> take();      ///< none: nothing is left, or all has ended
  void finish();                          ///< one that was taken
  void fail(std::exception_ptr failure);  ///< ends all
  void stop();                            ///< from now on nothing is handed out

  /// Until all pieces are finished; calls done(n) on this thread as they are, and now and then, so
  /// that it can notice an interrupt. Stops and throws the first failure, or what done throws.
  void wait(const std::function<void(std::size_t)>& done);

 private:
  const std::size_t count_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0;
  std::size_t finished_ = 0;
  bool stopped_ = false;
  std::exception_ptr failure_ = nullptr;
};

/// What a thread does with a piece, and who says it to each thread at its start: a worker need not
/// be safe to share.
using Worker = std::function<void(std::size_t)>;
using Hire = std::function<Worker()>;

/// Takes pieces on up to `jobs` threads (0: one per core) while there are any, and waits for all,
/// also for those that somebody else took. The first failure ends all and is thrown here, when the
/// threads have ended their pieces; so is what `done` throws.
void work_through(PieceQueue& queue, unsigned jobs, const Hire& hire,
                  const std::function<void(std::size_t)>& done);

/// Does work(0) ... work(count - 1) in the same way, in any order.
void work_in_parallel(std::size_t count, unsigned jobs, const Worker& work,
                      const std::function<void(std::size_t)>& done);

}  // namespace sketchloc

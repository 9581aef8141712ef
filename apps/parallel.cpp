#include "apps/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sketchloc {
namespace {

/// What the threads share.
struct Shared {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t finished = 0;              ///< under the mutex
  std::exception_ptr failure = nullptr;  ///< under the mutex
};

void run_worker(Shared& shared, std::size_t count, const std::function<void(std::size_t)>& work) {
  while (!shared.stop) {
    const std::size_t piece = shared.next++;
    if (piece >= count) {
      return;
    }
    std::exception_ptr failure;
    try {
      work(piece);
    } catch (...) {
      failure = std::current_exception();
      shared.stop = true;
    }
    const std::scoped_lock lock(shared.mutex);
    ++shared.finished;
    shared.failure = shared.failure ? shared.failure : failure;
    shared.changed.notify_one();
  }
}

/// Reports until everything is finished or failed; wakes up now and then, so that `done` can
/// notice an interrupt.
void report(Shared& shared, std::size_t count, const std::function<void(std::size_t)>& done) {
  std::unique_lock lock(shared.mutex);
  while (shared.finished < count && !shared.failure) {
    shared.changed.wait_for(lock, std::chrono::milliseconds(100));
    const std::size_t finished = shared.finished;
    lock.unlock();
    done(finished);
    lock.lock();
  }
}

}  // namespace

unsigned thread_count(unsigned jobs) {
  return jobs > 0 ? jobs : std::max(1U, std::thread::hardware_concurrency());
}

void work_in_parallel(std::size_t count, unsigned jobs,
                      const std::function<void(std::size_t)>& work,
                      const std::function<void(std::size_t)>& done) {
  Shared shared;
  {
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < std::min<std::size_t>(thread_count(jobs), count); ++i) {
      workers.emplace_back([&] { run_worker(shared, count, work); });
    }
    try {
      report(shared, count, done);
    } catch (...) {
      shared.stop = true;
      throw;  // after the workers have ended their pieces
    }
  }
  if (shared.failure) {
    std::rethrow_exception(shared.failure);
  }
}

}  // namespace sketchloc

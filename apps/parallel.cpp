#include "apps/parallel.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

namespace sketchloc {
namespace {

void run_worker(PieceQueue& queue, const Hire& hire) {
  try {
    const Worker work = hire();
    while (const std::optional<std::size_t> piece = queue.take()) {
      work(*piece);
      queue.finish();
    }
  } catch (...) {
    queue.fail(std::current_exception());
  }
}

}  // namespace

unsigned thread_count(unsigned jobs) {
  return jobs > 0 ? jobs : std::max(1U, std::thread::hardware_concurrency());
}

std::optional<std::size_t> PieceQueue::take() {
  const std::scoped_lock lock(mutex_);
  return stopped_ || next_ == count_ ? std::nullopt : std::optional(next_++);
}

void PieceQueue::finish() {
  const std::scoped_lock lock(mutex_);
  ++finished_;
  changed_.notify_one();
}

void PieceQueue::fail(std::exception_ptr failure) {
  const std::scoped_lock lock(mutex_);
  stopped_ = true;
  failure_ = failure_ ? failure_ : std::move(failure);
  changed_.notify_one();
}

void PieceQueue::stop() {
  const std::scoped_lock lock(mutex_);
  stopped_ = true;
}

void PieceQueue::wait(const std::function<void(std::size_t)>& done) {
  std::unique_lock lock(mutex_);
  while (finished_ < count_ && !failure_) {
    changed_.wait_for(lock, std::chrono::milliseconds(100));
    const std::size_t finished = finished_;
    lock.unlock();
    try {
      done(finished);
    } catch (...) {
      stop();
      throw;
    }
    lock.lock();
  }
  if (failure_) {
    std::rethrow_exception(failure_);
  }
}

void work_through(PieceQueue& queue, unsigned jobs, const Hire& hire,
                  const std::function<void(std::size_t)>& done) {
  std::vector<std::jthread> workers;
  for (std::size_t i = 0; i < std::min<std::size_t>(thread_count(jobs), queue.count()); ++i) {
    workers.emplace_back([&] { run_worker(queue, hire); });
  }
  queue.wait(done);
}

void work_in_parallel(std::size_t count, unsigned jobs, const Worker& work,
                      const std::function<void(std::size_t)>& done) {
  PieceQueue queue(count);
  work_through(
      queue, jobs, [&] { return work; }, done);
}

}  // namespace sketchloc

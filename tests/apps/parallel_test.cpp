#include "apps/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sketchloc {
namespace {

const auto kNothing = [](std::size_t) {};

TEST(WorkInParallel, DoesEachPieceOnce) {
  for (const unsigned jobs : {0U, 1U, 3U, 50U}) {
    std::vector<std::atomic<int>> times(20);
    work_in_parallel(
        times.size(), jobs, [&](std::size_t i) { ++times[i]; }, kNothing);
    for (const std::atomic<int>& count : times) {
      EXPECT_EQ(count, 1);
    }
  }
}

TEST(WorkInParallel, HasNothingToDoForNothing) {
  work_in_parallel(
      0, 2, [](std::size_t) { FAIL(); }, kNothing);
}

TEST(WorkInParallel, ThrowsTheFirstFailureAndStopsEarly) {
  std::atomic<int> started = 0;
  const auto fail = [&](std::size_t) {
    ++started;
    throw std::runtime_error("broken");
  };
  EXPECT_THROW(work_in_parallel(1000, 2, fail, kNothing), std::runtime_error);
  EXPECT_LE(started, 4);
}

TEST(WorkInParallel, StopsWhereTheReportThrows) {
  const auto report = [](std::size_t) { throw std::runtime_error("interrupted"); };
  std::atomic<int> finished = 0;
  const auto work = [&](std::size_t) {  // not over before the first report
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ++finished;
  };
  EXPECT_THROW(work_in_parallel(10'000, 2, work, report), std::runtime_error);
  EXPECT_LT(finished, 10'000);
}

}  // namespace
}  // namespace sketchloc

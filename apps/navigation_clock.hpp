#pragma once

#include <chrono>
#include <ctime>

#include "eval/navigation.hpp"

namespace sketchloc {

/// The clocks of this machine.
inline NavigationClock navigation_clock() {
  return {.wall_s =
              [] {
                const auto now = std::chrono::steady_clock::now().time_since_epoch();
                return std::chrono::duration<double>(now).count();
              },
          .processor_s =
              [] {
                timespec used{};
                clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
                return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
              }};
}

}  // namespace sketchloc

#include "apps/message_source.hpp"

#include <chrono>

namespace sketchloc {

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace sketchloc

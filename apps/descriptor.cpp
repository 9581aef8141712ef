#include "apps/descriptor.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace sketchloc {

Descriptor::~Descriptor() {
  if (number_ >= 0) {
    ::close(number_);
  }
}

WakeUp::WakeUp() : bell_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!bell_.is_open()) {
    throw std::system_error(errno, std::generic_category(), "eventfd");
  }
}

void WakeUp::ring() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t done = ::write(bell_.number(), &one, sizeof(one));
}

void WakeUp::hear() {
  std::uint64_t rings = 0;
  [[maybe_unused]] const ssize_t done = ::read(bell_.number(), &rings, sizeof(rings));
}

}  // namespace sketchloc

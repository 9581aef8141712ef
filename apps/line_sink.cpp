#include "apps/line_sink.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>

#include "apps/interrupt.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kPart = 4096;  // fits into a pipe that says it has room
constexpr int kWait_ms = 100;

int open_file(const std::filesystem::path& file, LineSink::Existing existing) {
  int flags = O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC;
  flags |= existing == LineSink::Existing::Refuse    ? O_EXCL
           : existing == LineSink::Existing::Replace ? O_TRUNC
                                                     : 0;
  const int descriptor = ::open(file.c_str(), flags, 0666);
  if (descriptor < 0 && errno == EEXIST) {
    throw std::invalid_argument(file.string() +
                                " exists; give another --out, or --force to replace it");
  }
  if (descriptor < 0) {
    throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(errno));
  }
  return descriptor;
}

}  // namespace

LineSink::LineSink() : name_("stdout"), descriptor_(STDOUT_FILENO) {
  std::signal(SIGPIPE, SIG_IGN);  // write() says so too, and states are kept first
}

LineSink::LineSink(const std::filesystem::path& file, Existing existing)
    : name_(file), own_(open_file(file, existing)), descriptor_(own_.number()) {}

bool LineSink::write(std::string_view line) {
  std::string text(line);
  text += '\n';
  std::string_view rest = text;
  while (!rest.empty()) {
    pollfd event{descriptor_, POLLOUT, 0};
    if (::poll(&event, 1, kWait_ms) <= 0) {
      if (end_was_asked_for()) {
        return false;
      }
      continue;
    }
    const ssize_t count = ::write(descriptor_, rest.data(), std::min(rest.size(), kPart));
    if (count < 0 && errno == EPIPE) {
      return false;
    }
    if (count < 0 && errno != EINTR && errno != EAGAIN) {
      throw std::runtime_error(name_.string() + ": cannot be written: " + std::strerror(errno));
    }
    rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  return true;
}

}  // namespace sketchloc

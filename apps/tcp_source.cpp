#include "apps/tcp_source.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace sketchloc {
namespace {

constexpr std::size_t kLongestLine = std::size_t{4} << 20;
constexpr std::size_t kLongestOutbox = std::size_t{4} << 20;

[[noreturn]] void fail(std::uint16_t port, const char* what) {
  throw std::runtime_error("--listen " + std::to_string(port) + ": " + what + ": " +
                           std::strerror(errno));
}

Descriptor listen_on(std::uint16_t port) {
  Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!listener.is_open()) {
    fail(port, "no socket");
  }
  const int yes = 1;  // so that the port of a program that ended can be used again at once
  ::setsockopt(listener.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::bind(listener.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) !=
      0) {
    fail(port, "the port cannot be used");
  }
  if (::listen(listener.number(), 4) != 0) {
    fail(port, "nobody can be listened to");
  }
  return listener;
}

std::uint16_t port_of(const Descriptor& listener) {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  ::getsockname(listener.number(), reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

}  // namespace

TcpSource::TcpSource(std::uint16_t port)
    : listener_(listen_on(port)), thread_([this] { serve(); }) {
  port_ = port_of(listener_);
}

TcpSource::~TcpSource() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  lines_.stop();
  wake_.ring();
  thread_.join();
}

bool TcpSource::stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

void TcpSource::serve() {
  while (!stopped()) {
    wait_for_client();
    if (client_.is_open()) {
      serve_client();
    }
  }
}

void TcpSource::wait_for_client() {
  std::array<pollfd, 2> events = {{{listener_.number(), POLLIN, 0}, {wake_.number(), POLLIN, 0}}};
  ::poll(events.data(), events.size(), -1);
  wake_.hear();
  client_ =
      Descriptor(::accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  const std::lock_guard lock(mutex_);
  connected_ = client_.is_open();
  answered_all_ = false;
  outbox_.clear();
}

/// Reads until the client says no more, and sends until all its answers are given.
void TcpSource::serve_client() {
  LineSplitter splitter(kLongestLine);
  bool reads = true;
  while (!stopped()) {
    bool has_answers = false;
    {
      const std::lock_guard lock(mutex_);
      has_answers = !outbox_.empty();
      if (!reads && answered_all_ && !has_answers) {
        break;
      }
    }
    const auto wanted = static_cast<short>((reads ? POLLIN : 0) | (has_answers ? POLLOUT : 0));
    std::array<pollfd, 2> events = {{{client_.number(), wanted, 0}, {wake_.number(), POLLIN, 0}}};
    ::poll(events.data(), events.size(), -1);
    wake_.hear();
    const bool broken = (events[0].revents & (POLLERR | POLLNVAL)) != 0;
    if (broken || ((events[0].revents & POLLOUT) != 0 && !send_some())) {
      leave("a client has gone before its answers");
      break;
    }
    if (reads && (events[0].revents & (POLLIN | POLLHUP)) != 0 && !read_some(splitter)) {
      reads = false;
      lines_.push({.kind = LineQueue::Kind::Pause, .text = {}, .arrived_s = steady_now_s()});
    }
    if (!reads && (events[0].revents & POLLHUP) != 0) {
      break;  // nobody is there to read answers
    }
  }
  if (reads) {
    lines_.push({.kind = LineQueue::Kind::Pause, .text = {}, .arrived_s = steady_now_s()});
  }
  hang_up();
}

/// Nobody else is let in before the scans of the last one are done: their answers are not his.
void TcpSource::hang_up() {
  client_.close();
  std::unique_lock lock(mutex_);
  connected_ = false;
  while (!answered_all_ && !stopped_) {
    lock.unlock();
    pollfd event{wake_.number(), POLLIN, 0};
    ::poll(&event, 1, -1);
    wake_.hear();
    lock.lock();
  }
}

/// False: nothing more will come.
bool TcpSource::read_some(LineSplitter& splitter) {
  std::array<char, 65536> bytes{};
  const ssize_t count = ::recv(client_.number(), bytes.data(), bytes.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return true;
  }
  const auto push = [this](LineSplitter::Line line) {
    return lines_.push({.kind = line.too_long ? LineQueue::Kind::TooLong : LineQueue::Kind::Line,
                        .text = std::move(line.text),
                        .arrived_s = steady_now_s()});
  };
  if (count <= 0) {
    if (std::optional<LineSplitter::Line> rest = splitter.rest()) {
      push(std::move(*rest));
    }
    return false;
  }
  splitter.feed({bytes.data(), static_cast<std::size_t>(count)}, push);
  return true;
}

/// False: nobody takes it.
bool TcpSource::send_some() {
  const std::lock_guard lock(mutex_);
  const ssize_t count = ::send(client_.number(), outbox_.data(), outbox_.size(), MSG_NOSIGNAL);
  if (count < 0) {
    return errno == EAGAIN || errno == EINTR;
  }
  outbox_.erase(0, static_cast<std::size_t>(count));
  return true;
}

void TcpSource::leave(const std::string& why) {
  const std::lock_guard lock(mutex_);
  complaint_ = why;
}

std::vector<Arrival> TcpSource::receive(double wait_s) {
  return arrivals_of(lines_.pop_all(wait_s), "127.0.0.1:" + std::to_string(port_), line_number_);
}

void TcpSource::answer(std::string_view line) {
  {
    const std::lock_guard lock(mutex_);
    if (!connected_) {
      return;
    }
    if (outbox_.size() + line.size() > kLongestOutbox) {
      complaint_ = "the client does not read its answers; some are left out";
      return;
    }
    outbox_.append(line);
    outbox_ += '\n';
  }
  wake_.ring();
}

void TcpSource::answered_all() {
  {
    const std::lock_guard lock(mutex_);
    answered_all_ = true;
  }
  wake_.ring();
}

std::optional<std::string> TcpSource::complaint() {
  const std::lock_guard lock(mutex_);
  return std::exchange(complaint_, std::nullopt);
}

}  // namespace sketchloc

#include "apps/stream_source.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "apps/line_splitter.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kLongestLine = std::size_t{4} << 20;

LineQueue::Item item_of(LineSplitter::Line line) {
  return {.kind = line.too_long ? LineQueue::Kind::TooLong : LineQueue::Kind::Line,
          .text = std::move(line.text),
          .arrived_s = steady_now_s()};
}

}  // namespace

StreamSource::StreamSource(int descriptor, std::string name)
    : name_(std::move(name)), reader_([this, descriptor] { read_all(descriptor); }) {}

StreamSource::~StreamSource() {
  lines_.stop();
  stop_.ring();
  reader_.join();
}

void StreamSource::read_all(int descriptor) {
  LineSplitter splitter(kLongestLine);
  std::array<char, 65536> bytes{};
  bool wanted = true;
  while (wanted) {
    std::array<pollfd, 2> events = {{{descriptor, POLLIN, 0}, {stop_.number(), POLLIN, 0}}};
    if (::poll(events.data(), events.size(), -1) < 0 && errno != EINTR) {
      break;
    }
    if (events[1].revents != 0) {
      break;
    }
    const ssize_t count =
        events[0].revents != 0 ? ::read(descriptor, bytes.data(), bytes.size()) : 0;
    if (events[0].revents != 0 && count <= 0 && errno != EINTR && errno != EAGAIN) {
      break;
    }
    splitter.feed(
        {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))},
        [&](LineSplitter::Line line) { wanted = lines_.push(item_of(std::move(line))) && wanted; });
  }
  if (std::optional<LineSplitter::Line> rest = splitter.rest()) {
    lines_.push(item_of(std::move(*rest)));
  }
  lines_.close();
}

std::vector<Arrival> StreamSource::receive(double wait_s) {
  return arrivals_of(lines_.pop_all(wait_s), name_, line_number_);
}

}  // namespace sketchloc

#include "apps/line_queue.hpp"

#include <chrono>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "datasets/io/message_io.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;
constexpr std::size_t kMostLines = 10'000;

}  // namespace

bool LineQueue::push(Item item) {
  std::unique_lock lock(mutex_);
  const auto has_room = [this] {
    return stopped_ || items_.empty() || (bytes_ < kMostBytes && items_.size() < kMostLines);
  };
  changed_.wait(lock, has_room);
  bytes_ += item.text.size();
  items_.push_back(std::move(item));
  changed_.notify_all();
  return !stopped_;
}

void LineQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

void LineQueue::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

std::vector<LineQueue::Item> LineQueue::pop_all(double wait_s) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(wait_s),
                    [this] { return closed_ || !items_.empty(); });
  std::vector<Item> all(std::make_move_iterator(items_.begin()),
                        std::make_move_iterator(items_.end()));
  items_.clear();
  bytes_ = 0;
  changed_.notify_all();
  return all;
}

bool LineQueue::at_end() const {
  const std::lock_guard lock(mutex_);
  return closed_ && items_.empty();
}

std::vector<Arrival> arrivals_of(std::vector<LineQueue::Item> items, const std::string& source,
                                 std::size_t& line_number) {
  std::vector<Arrival> arrivals;
  for (LineQueue::Item& item : items) {
    Arrival arrival{.arrived_s = item.arrived_s, .message = {}, .problem = {}};
    line_number += item.kind == LineQueue::Kind::Pause ? 0 : 1;
    if (item.kind == LineQueue::Kind::Pause) {
      arrival.kind = Arrival::Kind::Pause;
    } else if (item.kind == LineQueue::Kind::TooLong) {
      arrival.kind = Arrival::Kind::Malformed;
      arrival.problem = source + ":" + std::to_string(line_number) +
                        ": the line is longer than 4 MiB; write one message per line";
    } else if (item.text.find_first_not_of(" \t") == std::string::npos) {
      continue;
    } else {
      try {
        ReadMessage read = parse_json_message(item.text, source, line_number);
        arrival.message = std::move(read.message);
        arrival.had_nan = read.had_nan;
      } catch (const std::runtime_error& error) {
        arrival.kind = Arrival::Kind::Malformed;
        arrival.problem = error.what();
      }
    }
    arrivals.push_back(std::move(arrival));
  }
  return arrivals;
}

}  // namespace sketchloc

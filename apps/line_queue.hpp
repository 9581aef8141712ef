#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "apps/message_source.hpp"

namespace sketchloc {

/// Lines on their way from a thread that reads them to the one that uses them, in bounded memory:
/// where too many wait, the reader waits too, and so does whoever writes to it.
class LineQueue {
 public:
  enum class Kind { Line, TooLong, Pause };
  struct Item {
    Kind kind = Kind::Line;
    std::string text;
    double arrived_s = 0.0;
  };

  /// Waits for room; gives up, and says so, once stop() was called.
  bool push(Item item);
  /// Nothing more will be pushed.
  void close();
  /// Nobody will pop any more.
  void stop();

  /// All that is there; where nothing is, waits up to wait_s.
  std::vector<Item> pop_all(double wait_s);
  /// Closed and empty.
  bool at_end() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
  std::size_t bytes_ = 0;
  bool closed_ = false;
  bool stopped_ = false;
};

/// Reads the lines as messages. `source` and the running number go into what is said of bad ones.
std::vector<Arrival> arrivals_of(std::vector<LineQueue::Item> items, const std::string& source,
                                 std::size_t& line_number);

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <string>
#include <thread>

#include "apps/descriptor.hpp"
#include "apps/line_queue.hpp"
#include "apps/message_source.hpp"

namespace sketchloc {

/// Messages from a stream that is open already, such as stdin. A thread of its own reads, so that
/// arrival times are true while somebody else computes.
class StreamSource final : public MessageSource {
 public:
  /// The descriptor stays the caller's. `name` goes into what is said of bad lines.
  StreamSource(int descriptor, std::string name);
  ~StreamSource() override;

  std::vector<Arrival> receive(double wait_s) override;
  bool at_end() const override { return lines_.at_end(); }

 private:
  void read_all(int descriptor);

  std::string name_;
  std::size_t line_number_ = 0;
  LineQueue lines_;
  WakeUp stop_;
  std::thread reader_;  // last, so that everything else is there before it starts
};

}  // namespace sketchloc

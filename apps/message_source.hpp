#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/message.hpp"

namespace sketchloc {

/// Seconds of a clock that never goes back.
double steady_now_s();

/// Something that came in.
struct Arrival {
  enum class Kind {
    Message,
    Malformed,  ///< something that is no message
    Pause,      ///< whoever sent has gone, somebody else may come
  };
  Kind kind = Kind::Message;
  double arrived_s = 0.0;  ///< by steady_now_s
  Message message;         ///< if it is one
  bool had_nan = false;
  std::string problem;  ///< if malformed: one sentence for people
};

/// Where messages come from.
class MessageSource {
 public:
  virtual ~MessageSource() = default;
  MessageSource(const MessageSource&) = delete;
  MessageSource& operator=(const MessageSource&) = delete;

  /// What has come; where nothing has, waits for something up to wait_s.
  virtual std::vector<Arrival> receive(double wait_s) = 0;

  /// Nothing more will come.
  virtual bool at_end() const = 0;

  /// Tells whoever sends the messages, if that can be.
  virtual void answer(std::string_view /*line*/) {}
  /// All answers to those that came before the last Pause are given.
  virtual void answered_all() {}

  /// Why answers are lost, if they are, since the last call.
  virtual std::optional<std::string> complaint() { return std::nullopt; }

 protected:
  MessageSource() = default;
};

}  // namespace sketchloc

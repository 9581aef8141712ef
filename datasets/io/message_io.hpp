#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "datasets/message.hpp"

namespace sketchloc {

/// A message and what a person should know about how it was read.
struct ReadMessage {
  Message message;
  bool had_nan = false;  ///< NaN or Infinity, which JSON has not; taken as null
};

/// One message from one line of JSON: a step of a log (docs/formats.md), or its odometry or its
/// scan alone. NaN and infinity, which many a robot writes, count as null. Throws
/// std::runtime_error with source, line, field, what was expected and what was found.
ReadMessage parse_json_message(std::string_view line, const std::filesystem::path& source,
                               std::size_t line_number);

}  // namespace sketchloc

// One line of JSON as a robot sends it.

#include <stdexcept>
#include <string_view>

#include "datasets/io/message_io.hpp"
#include "datasets/io/run_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  try {
    const std::string once = json_line(parse_json_step(line, "stdin", 1));
    const std::string twice = json_line(parse_json_step(once, "stdin", 1));
    fuzz::require(once.size() > 0 && twice.size() > 0, "a step survives JSON");
  } catch (const std::runtime_error&) {
  }
  try {
    const Message message = parse_json_message(line, "stdin", 1).message;
    fuzz::require(message.scan || message.odom_from_robot, "a message says something");
  } catch (const std::runtime_error&) {
  }
  return 0;
}

#include "datasets/io/detail/whole_lines.hpp"

#include <stdexcept>

namespace sketchloc::detail {
namespace {

std::vector<std::string> torn_end(const Place& place, const RunReading& reading,
                                  const std::string& what) {
  if (!reading.allow_truncated) {
    fail(place, what + "; copy the file again, or keep what is whole with --allow-truncated");
  }
  return {"dropped the torn end of the log at line " + std::to_string(place.line) + ": " + what};
}

}  // namespace

TextLimits text_limits(const RunReading& reading) {
  return {.line_bytes = reading.max_line_bytes, .total_bytes = reading.max_total_bytes};
}

std::vector<std::string> for_each_whole_line(
    LineReader& lines, const RunReading& reading,
    const std::function<void(std::string_view line, const Place& place)>& parse) {
  while (const std::optional<std::string_view> line = lines.next()) {
    if (lines.line_was_ended()) {
      parse(*line, lines.place());
    } else if (lines.cut_off()) {
      return torn_end(lines.place(), reading, "the gzip stream ends in the middle of this line");
    } else {
      try {
        parse(*line, lines.place());
      } catch (const std::runtime_error& error) {
        return torn_end(
            lines.place(), reading,
            std::string("the log ends in the middle of this line (") + error.what() + ")");
      }
    }
  }
  if (lines.cut_off()) {
    return torn_end(lines.place(), reading, "the gzip stream ends early, after this line");
  }
  return {};
}

void expect_order_of_time(const std::vector<RunStep>& steps, double time_s, const Place& place) {
  if (!steps.empty() && time_s < steps.back().scan.time_s) {
    fail_expected(
        place, "time",
        "at least the " + std::to_string(steps.back().scan.time_s) + " s of the step before",
        std::to_string(time_s) + " s", "put the lines in order of time");
  }
}

}  // namespace sketchloc::detail

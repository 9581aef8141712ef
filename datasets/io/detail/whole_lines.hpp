#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/io/detail/line_reader.hpp"
#include "datasets/io/run_io.hpp"

namespace sketchloc::detail {

TextLimits text_limits(const RunReading& reading);

/// Gives every line to `parse`, which throws std::runtime_error if it is malformed. A log that
/// stops in the middle of its last line (a robot that lost power) is an error that says how to
/// keep the rest; with allow_truncated the torn end is dropped. Returns the notes on that.
std::vector<std::string> for_each_whole_line(
    LineReader& lines, const RunReading& reading,
    const std::function<void(std::string_view line, const Place& place)>& parse);

/// An error if a step at that time would come before the last one.
void expect_order_of_time(const std::vector<RunStep>& steps, double time_s, const Place& place);

}  // namespace sketchloc::detail

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/run.hpp"

namespace sketchloc {

/// How a log is read. Formats, units and conventions: docs/formats.md.
struct RunReading {
  /// Ranges from here on are no returns, in (0, inf); by default what the log says, else 80 m
  /// (a SICK LMS says 81.83 or 81.91 for "nothing there").
  std::optional<double> max_range_m = std::nullopt;
  /// Keep the whole lines of a log that stops in the middle of a line or of its gzip stream.
  bool allow_truncated = false;
  std::size_t max_line_bytes = std::size_t{4} << 20;       ///< longer lines are an error
  std::uint64_t max_total_bytes = std::uint64_t{1} << 30;  ///< after unpacking; more is an error
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const RunReading& reading);

/// A run and what a person should know about how it was read (one sentence each).
struct RunFile {
  Run run;
  std::vector<std::string> notes;
};

/// Reads a CARMEN log or JSON lines, plain or gzip, both found by content. Throws
/// std::runtime_error with file, line, field, what was expected and what was found.
RunFile read_run_file(const std::filesystem::path& log, const RunReading& reading = {});
Run read_run(const std::filesystem::path& log, const RunReading& reading = {});

/// CARMEN: FLASER (raw odometry in its second pose) or ROBOTLASER1, ODOM and PARAM lines.
RunFile read_carmen(const std::filesystem::path& log, const RunReading& reading = {});

/// JSON lines: one step per line, as write_jsonl writes them.
RunFile read_jsonl(const std::filesystem::path& log, const RunReading& reading = {});

/// One step from one line of JSON; errors name `source` and `line_number`. For what robots send as
/// they drive: parse_json_message (datasets/io/message_io.hpp).
RunStep parse_json_step(std::string_view line, const std::filesystem::path& source,
                        std::size_t line_number);

/// The line for one step, without the end of line. Throws std::invalid_argument for a step that
/// JSON cannot say: a pose, a time or an angle that is not finite. NaN ranges become null.
std::string json_line(const RunStep& step);

/// Writes one step per line, atomically; packed by gzip where the name ends in .gz.
void write_jsonl(const std::filesystem::path& log, const Run& run);

}  // namespace sketchloc

#include "datasets/io/run_io.hpp"

#include <array>

#include "datasets/io/detail/carmen.hpp"
#include "datasets/io/detail/jsonl.hpp"
#include "datasets/io/detail/whole_lines.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// Files that people take for logs, by how they start.
struct Stranger {
  std::string_view start;
  std::string_view message;
};

constexpr std::array kStrangers = {
    Stranger{"#ROSBAG", "a ROS 1 bag"},
    Stranger{"\x89MCAP", "an MCAP file (ROS 2)"},
    Stranger{"SQLite format 3", "an SQLite file (ROS 2 bag?)"},
    Stranger{"\x89PNG", "a PNG picture"},
    Stranger{"PK\x03\x04", "a ZIP archive; unpack it first"},
    Stranger{"BZh", "a bzip2 file; unpack it first"},
    Stranger{"\xfd"
             "7zXZ",
             "an xz file; unpack it first"},
    Stranger{"\x28\xb5\x2f\xfd", "a Zstandard file; unpack it first"},
};

void refuse_strangers(std::string_view first_line, const detail::Place& place) {
  for (const Stranger& stranger : kStrangers) {
    if (first_line.starts_with(stranger.start)) {
      detail::fail_expected(place, "format", "a CARMEN log or JSON lines, plain or gzip",
                            stranger.message, "");
    }
  }
}

}  // namespace

void validate(const RunReading& reading) {
  if (reading.max_range_m) {
    require_above("max_range_m", *reading.max_range_m, 0.0);
  }
  require_above("max_line_bytes", static_cast<double>(reading.max_line_bytes), 0.0);
  require_above("max_total_bytes", static_cast<double>(reading.max_total_bytes), 0.0);
}

RunFile read_run_file(const std::filesystem::path& log, const RunReading& reading) {
  validate(reading);
  detail::LineReader lines(log, detail::text_limits(reading));
  const std::optional<std::string_view> first = lines.peek();
  if (!first && !lines.cut_off()) {
    detail::fail({.file = log}, "is empty; expected a CARMEN log or JSON lines");
  }
  const std::string_view first_line = first.value_or("");
  refuse_strangers(first_line, lines.place());
  const std::size_t start = first_line.find_first_not_of(" \t");
  const bool is_json = start != std::string_view::npos && first_line[start] == '{';
  return is_json ? detail::read_json_lines(lines, reading)
                 : detail::read_carmen_lines(lines, reading);
}

Run read_run(const std::filesystem::path& log, const RunReading& reading) {
  return read_run_file(log, reading).run;
}

}  // namespace sketchloc

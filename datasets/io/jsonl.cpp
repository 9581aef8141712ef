#include "datasets/io/detail/jsonl.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "datasets/io/atomic_file.hpp"
#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/gzip.hpp"
#include "datasets/io/detail/json_fields.hpp"
#include "datasets/io/detail/limits.hpp"
#include "datasets/io/detail/step_fields.hpp"
#include "datasets/io/detail/whole_lines.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace detail {
namespace {

RunStep read_step(std::string_view line, const Place& place) {
  const nlohmann::json json = parse_json(line, place);
  const JsonFields fields(json, "", place, {"time_s", "odometry", "scan"});
  RunStep step;
  step.odom_from_robot = read_json_pose(fields, "odometry");
  step.scan = read_json_scan(fields);
  return step;
}

void append_field(std::string& text, std::string_view name, double value) {
  if (!std::isfinite(value)) {
    throw std::invalid_argument(std::string(name) + " must be finite to be written as JSON");
  }
  text += '"';
  text += name;
  text += "\":";
  append_number(text, value);
}

void append_pose(std::string& text, const Se2& pose) {
  text += '{';
  append_field(text, "x_m", pose.x_m());
  text += ',';
  append_field(text, "y_m", pose.y_m());
  text += ',';
  append_field(text, "yaw_rad", pose.yaw_rad());
  text += '}';
}

void append_ranges(std::string& text, const std::vector<float>& ranges_m) {
  text += '[';
  for (std::size_t beam = 0; beam < ranges_m.size(); ++beam) {
    text += beam > 0 ? "," : "";
    if (std::isfinite(ranges_m[beam])) {
      append_number(text, ranges_m[beam]);
    } else {
      text += "null";
    }
  }
  text += ']';
}

}  // namespace

RunFile read_json_lines(LineReader& lines, const RunReading& reading) {
  RunFile file;
  file.notes = for_each_whole_line(lines, reading, [&](std::string_view line, const Place& place) {
    if (line.find_first_not_of(" \t") == std::string_view::npos) {
      return;
    }
    RunStep step = read_step(line, place);
    step.scan.max_range_m = reading.max_range_m.value_or(step.scan.max_range_m);
    expect_order_of_time(file.run.steps, step.scan.time_s, place);
    file.run.steps.push_back(std::move(step));
  });
  if (file.run.steps.empty()) {
    fail({.file = lines.place().file}, "steps: expected one JSON object per line, found none");
  }
  return file;
}

}  // namespace detail

RunFile read_jsonl(const std::filesystem::path& log, const RunReading& reading) {
  validate(reading);
  detail::LineReader lines(log, detail::text_limits(reading));
  return detail::read_json_lines(lines, reading);
}

RunStep parse_json_step(std::string_view line, const std::filesystem::path& source,
                        std::size_t line_number) {
  return detail::read_step(line, {.file = source, .line = line_number});
}

std::string json_line(const RunStep& step) {
  using detail::append_field;
  const Scan& scan = step.scan;
  std::string text = "{";
  append_field(text, "time_s", scan.time_s);
  text += ",\"odometry\":";
  detail::append_pose(text, step.odom_from_robot);
  text += ",\"scan\":{";
  append_field(text, "first_angle_rad", scan.first_angle_rad);
  text += ',';
  append_field(text, "angle_step_rad", scan.angle_step_rad);
  text += ',';
  append_field(text, "min_range_m", scan.min_range_m);
  text += ',';
  append_field(text, "max_range_m", scan.max_range_m);
  text += ",\"robot_from_laser\":";
  detail::append_pose(text, scan.robot_from_laser);
  text += ",\"ranges_m\":";
  detail::append_ranges(text, scan.ranges_m);
  text += "}}";
  return text;
}

void write_jsonl(const std::filesystem::path& log, const Run& run) {
  std::string text;
  for (const RunStep& step : run.steps) {
    text += json_line(step);
    text += '\n';
  }
  write_atomically(log, log.extension() == ".gz" ? detail::gzipped(text) : text);
}

}  // namespace sketchloc

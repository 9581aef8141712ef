#include "datasets/io/message_io.hpp"

#include <array>
#include <string>

#include "datasets/io/detail/limits.hpp"
#include "datasets/io/detail/step_fields.hpp"

namespace sketchloc {
namespace {

constexpr std::array<std::string_view, 7> kNoNumbers = {"-Infinity", "Infinity", "-NaN", "NaN",
                                                        "-nan",      "nan",      "null"};

/// The word that begins here and that is no number; empty: none.
std::string_view no_number_at(std::string_view text) {
  for (const std::string_view word : kNoNumbers) {
    if (text.starts_with(word)) {
      return word;
    }
  }
  return {};
}

/// The same line with null for NaN and infinity outside of strings.
std::string with_null_for_nan(std::string_view line, bool& had_nan) {
  std::string text;
  text.reserve(line.size());
  bool in_string = false;
  for (std::size_t i = 0; i < line.size();) {
    const std::string_view word = in_string ? std::string_view() : no_number_at(line.substr(i));
    if (!word.empty()) {
      text += "null";
      had_nan = had_nan || word != "null";
      i += word.size();
      continue;
    }
    const bool escape = in_string && line[i] == '\\';
    in_string = (line[i] == '"') != in_string;
    text.append(line.substr(i, escape ? 2 : 1));
    i += escape ? 2 : 1;
  }
  return text;
}

bool may_have_nan(std::string_view line) {
  return line.find("NaN") != line.npos || line.find("nan") != line.npos ||
         line.find("Infinity") != line.npos;
}

}  // namespace

ReadMessage parse_json_message(std::string_view line, const std::filesystem::path& source,
                               std::size_t line_number) {
  const detail::Place place{.file = source, .line = line_number};
  ReadMessage read;
  std::string changed;
  if (may_have_nan(line)) {
    changed = with_null_for_nan(line, read.had_nan);
    line = changed;
  }
  const nlohmann::json json = detail::parse_json(line, place);
  const detail::JsonFields fields(json, "", place, {"time_s", "odometry", "scan"});
  read.message.time_s = fields.number("time_s", detail::kMostTime_s);
  if (fields.has("odometry")) {
    read.message.odom_from_robot = detail::read_json_pose(fields, "odometry");
  }
  if (fields.has("scan")) {
    read.message.scan = detail::read_json_scan(fields);
  }
  if (!read.message.odom_from_robot && !read.message.scan) {
    detail::fail(place,
                 "a message needs \"odometry\", \"scan\" or both; the fields are listed in "
                 "docs/formats.md");
  }
  return read;
}

}  // namespace sketchloc

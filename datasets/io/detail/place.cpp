#include "datasets/io/detail/place.hpp"

#include <stdexcept>

namespace sketchloc::detail {

void fail(const Place& place, std::string_view message) {
  std::string text = place.file.string();
  if (place.line > 0) {
    text += ":" + std::to_string(place.line);
  }
  text += ": ";
  text += message;
  throw std::runtime_error(text);
}

void fail_expected(const Place& place, std::string_view field, std::string_view expected,
                   std::string_view found, std::string_view what_to_do) {
  std::string message(field);
  message += ": expected ";
  message += expected;
  message += ", found ";
  message += found;
  if (!what_to_do.empty()) {
    message += "; ";
    message += what_to_do;
  }
  fail(place, message);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongest)) {
    const bool printable = c >= ' ' && c <= '~';
    out += printable ? c : '?';
  }
  out += text.size() > kLongest ? "...\"" : "\"";
  return out;
}

}  // namespace sketchloc::detail

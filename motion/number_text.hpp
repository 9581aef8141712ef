#pragma once

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace sketchloc {

/// Appends the shortest text that reads back as the same number, in the C locale. NaN is "nan".
template <typename Number>
void append_number(std::string& text, Number number) {
  std::array<char, 64> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), end);
}

template <typename Number>
std::string number_text(Number number) {
  std::string text;
  append_number(text, number);
  return text;
}

/// The whole text as a number, in the C locale whatever the program's; none if it is not one or
/// does not fit the type. "nan" and "inf" are numbers here, a leading plus sign is allowed.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) {
    text.remove_prefix(1);  // from_chars knows no plus sign
  }
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? std::optional<Number>(number) : std::nullopt;
}

}  // namespace sketchloc

#pragma once

#include <array>
#include <charconv>
#include <string>

namespace sketchloc::detail {

/// Appends the shortest text that reads back as the same number, in the C locale. NaN is "nan".
template <typename Number>
void append_number(std::string& text, Number number) {
  std::array<char, 64> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), end);
}

}  // namespace sketchloc::detail

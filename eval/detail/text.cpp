#include "eval/detail/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace sketchloc::detail {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::string_view kNoBreakSpace = "\xC2\xA0";

unsigned byte_of(char c) { return static_cast<unsigned char>(c); }

bool continues(std::string_view text, std::size_t index) {
  return index < text.size() && (byte_of(text[index]) & 0xC0U) == 0x80U;
}

/// Bytes of the UTF-8 character that starts the text; 0 where there is none. Overlong forms,
/// surrogates and what lies beyond U+10FFFF are none. [RFC 3629]
std::size_t utf8_length(std::string_view text) {
  const unsigned first = byte_of(text[0]);
  if (first < 0x80U) {
    return 1;
  }
  const unsigned second = text.size() > 1 ? byte_of(text[1]) : 0U;
  if (first >= 0xC2U && first <= 0xDFU) {
    return continues(text, 1) ? 2 : 0;
  }
  if ((first & 0xF0U) == 0xE0U) {
    const bool overlong = first == 0xE0U && second < 0xA0U;
    const bool surrogate = first == 0xEDU && second > 0x9FU;
    return continues(text, 1) && continues(text, 2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0U && first <= 0xF4U) {
    const bool overlong = first == 0xF0U && second < 0x90U;
    const bool beyond = first == 0xF4U && second > 0x8FU;
    const bool whole = continues(text, 1) && continues(text, 2) && continues(text, 3);
    return whole && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

std::string_view escaped_ascii(char c, std::string_view itself) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\n':
    case '\t':
      return itself;
    default:
      return byte_of(c) < 0x20U || byte_of(c) == 0x7FU ? kReplacement : itself;
  }
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 1) {
      result += escaped_ascii(text[0], text.substr(0, 1));
    } else {
      result += length == 0 ? kReplacement : text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) {
    return "\xE2\x80\x93";  // en dash
  }
  std::array<char, 400> buffer;  // the longest double has 309 digits before the point
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals);
  std::string text(buffer.data(), end.ptr);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text[0] == '-' ? text.substr(1) : text;
}

std::string short_number(double value) {
  std::string text = fixed(value, 2);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
  }
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

std::string percent(double share) {
  return fixed(100.0 * share, 0).append(kNoBreakSpace).append("%");
}

std::string with_unit(double value, std::string_view unit) {
  const double size = std::abs(value);
  const int decimals = size < 10.0 ? 2 : size < 100.0 ? 1 : 0;
  return fixed(value, decimals).append(kNoBreakSpace).append(unit);
}

std::string duration(double seconds) {
  constexpr double kMinute = 60.0;
  if (!(std::abs(seconds) >= 2.0 * kMinute)) {
    return fixed(seconds, seconds != 0.0 && std::abs(seconds) < 10.0 ? 1 : 0)
        .append(kNoBreakSpace)
        .append("s");
  }
  const double whole = std::round(seconds);
  const double minutes = std::floor(whole / kMinute);
  return fixed(minutes, 0)
      .append(kNoBreakSpace)
      .append("min ")
      .append(fixed(whole - minutes * kMinute, 0))
      .append(kNoBreakSpace)
      .append("s");
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? byte_of(bytes[i + k]) : 0U;
    };
    const unsigned triple = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (unsigned digit = 0; digit < 4; ++digit) {
      const bool padding = i + digit > bytes.size();
      text += padding ? '=' : kDigits[triple >> (18U - 6U * digit) & 63U];
    }
  }
  return text;
}

}  // namespace sketchloc::detail

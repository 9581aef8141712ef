#pragma once

#include <string>
#include <string_view>

namespace sketchloc::detail {

/// Any bytes as text of an HTML page or of a quoted attribute: markup is escaped, control
/// characters and broken UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// Decimal number whatever the locale; an en dash where it is not finite.
std::string fixed(double value, int decimals);

/// As short as two decimals allow: "3", "0.5", "1.25".
std::string short_number(double value);

/// "87 %" of 0.874.
std::string percent(double share);

/// With a no-break space and as many digits as one reads: "0.83 m", "12.4 m", "148 m".
std::string with_unit(double value, std::string_view unit);

/// "48 s" or "5 min 12 s".
std::string duration(double seconds);

/// Bytes as base64, for data URIs.
std::string base64(std::string_view bytes);

}  // namespace sketchloc::detail

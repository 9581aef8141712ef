#pragma once

#include <source_location>
#include <string_view>

namespace sketchloc {

[[noreturn]] void check_failed(std::string_view what, const std::source_location& where);

/// Aborts with file and line when the caller's code broke a contract; on in every build type.
/// Wrong input (files, flags, parameters) throws instead, see CONTRIBUTING.md.
inline void check(bool holds, std::string_view what,
                  const std::source_location& where = std::source_location::current()) {
  if (!holds) [[unlikely]] {
    check_failed(what, where);
  }
}

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace sketchloc::detail {

/// A line of a file, for messages; line 0 stands for the file as a whole.
struct Place {
  std::filesystem::path file;
  std::size_t line = 0;
};

/// Throws std::runtime_error "file:line: message".
[[noreturn]] void fail(const Place& place, std::string_view message);

/// Throws std::runtime_error "file:line: field: expected ..., found "..."; what to do".
[[noreturn]] void fail_expected(const Place& place, std::string_view field,
                                std::string_view expected, std::string_view found,
                                std::string_view what_to_do);

/// A piece of input fit to be quoted in one line of a message: printable, at most 40 characters.
std::string in_quotes(std::string_view text);

}  // namespace sketchloc::detail

#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sketchloc {

/// The bytes of a file; none where it cannot be read or is no file.
std::optional<std::string> read_bytes(const std::filesystem::path& file);
/// The same; throws std::runtime_error where it cannot be read.
std::string bytes_of(const std::filesystem::path& file);

}  // namespace sketchloc

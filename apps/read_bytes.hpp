#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace sketchloc {

/// The bytes of a file; none where it cannot be read or is no file.
std::optional<std::string> read_bytes(const std::filesystem::path& file);

}  // namespace sketchloc

#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace sketchloc {

/// 16 hexadecimal digits that change when the bytes do. Not against forgery.
std::string fingerprint(std::span<const std::byte> bytes);

/// Of a file's content; "none" where it cannot be read.
std::string fingerprint_of_file(const std::filesystem::path& file);

}  // namespace sketchloc

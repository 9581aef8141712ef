#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace sketchloc::detail {

/// A whole file; throws on more than `most_bytes` and on nothing at all.
std::vector<unsigned char> read_bytes(const std::filesystem::path& file, std::size_t most_bytes);

}  // namespace sketchloc::detail

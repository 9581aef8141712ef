#pragma once

#include <filesystem>
#include <string_view>

namespace sketchloc {

/// Writes a file so that readers see the old content or the new one, never a part: a temporary
/// file beside it, flushed to the disk, then renamed. Leaves no temporary file behind when it
/// fails. Throws std::runtime_error with the path and the reason.
void write_atomically(const std::filesystem::path& file, std::string_view content);

}  // namespace sketchloc

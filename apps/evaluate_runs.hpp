#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace sketchloc {

/// A table of many runs, as markdown: one line per folder, over the runs in the folders below it (a
/// folder per seed), named by the folder and the one above it. With `against`, the paired
/// differences to that folder follow, over the runs of the same name. Throws std::runtime_error
/// for a run without readable metrics.json and for a folder without runs.
std::string runs_table(std::span<const std::filesystem::path> folders,
                       const std::optional<std::filesystem::path>& against);

}  // namespace sketchloc

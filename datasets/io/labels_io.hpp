#pragma once

#include <filesystem>
#include <vector>

#include "datasets/place_label.hpp"

namespace sketchloc {

/// Reads the kind of place of every pose of a run: a CSV with the columns `index` (0, 1, 2 ...) and
/// `label_name` (rackspace, corridor, intersection or trisection), one row per pose; other columns
/// are ignored. Throws std::runtime_error with file, line and column.
std::vector<PlaceLabel> read_labels(const std::filesystem::path& csv);

/// Writes such a file, atomically.
void write_labels(const std::filesystem::path& csv, const std::vector<PlaceLabel>& labels);

}  // namespace sketchloc

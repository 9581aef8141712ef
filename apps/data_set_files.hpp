#pragma once

#include <filesystem>

#include "apps/run_file.hpp"
#include "datasets/sim/data_set.hpp"

namespace sketchloc {

/// Writes a simulated data set into a folder that exists: drawing.png, log.jsonl, reference.csv,
/// truth.tum (world_from_robot), picture.png (the drawing with the true path) and run.yaml (what
/// made it); drawing.yaml for map_server where the drawing has a known scale; labels.csv (what kind
/// of place the robot is at) where the building has racks.
void write_data_set(const std::filesystem::path& folder, const DataSet& data_set,
                    const RunDescription& made_by);

}  // namespace sketchloc

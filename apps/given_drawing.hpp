#pragma once

#include <filesystem>
#include <span>

#include "apps/config_node.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/sim/building.hpp"
#include "datasets/sim/correspondence_fit.hpp"
#include "datasets/sim/data_set.hpp"

namespace sketchloc {

/// A drawing that somebody made of a building, with how it distorts the building's map.
struct GivenDrawing {
  Drawing drawing;
  CorrespondenceFit fit;
};

/// Reads the drawing and the places that were found in it and in the map's picture, all files
/// together, and fits the drawing's distortion. Throws std::runtime_error where they allow none.
GivenDrawing read_given_drawing(const std::filesystem::path& drawing, const SketchReading& reading,
                                std::span<const std::filesystem::path> correspondences,
                                const MetricMap& map);

/// How well the reference of a data set in a given drawing is known, for people: reference.yaml.
ConfigNode support_of(const DataSet& data_set, const CorrespondenceFit& fit);

}  // namespace sketchloc

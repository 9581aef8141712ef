#pragma once

#include <span>
#include <string>
#include <vector>

#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sketch.hpp"

namespace sketchloc {

// Inputs that can be read and make no sense: sentences for people, without the name of the file.

/// Of a drawing: so many separate blobs that it is a photo or noise, or no place with strokes all
/// around.
std::vector<std::string> doubts_about(const Sketch& sketch);

/// Of a log: no scan, or hardly one, has a return.
std::vector<std::string> doubts_about(const Run& run);

/// Of a reference, beside the times of the run's scans: poses for part of the run only, or for
/// scans that the run does not have.
std::vector<std::string> doubts_about(const Reference& reference,
                                      std::span<const double> scan_times_s);

/// Do the times of most of the reference's poses differ from those of their scans?
bool is_of_another_run(const Reference& reference, std::span<const double> scan_times_s);

}  // namespace sketchloc

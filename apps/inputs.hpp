#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sketch.hpp"

namespace sketchloc {

// What commands that look at a drawing and a log read, with notes and warnings on stderr.

void warn_of(const std::filesystem::path& file, const std::vector<std::string>& doubts);

Sketch read_drawing_input(const std::filesystem::path& drawing, const SketchReading& reading);

Run read_log_input(const std::filesystem::path& log, const RunReading& reading);

/// A run with the name that people know it by.
struct NamedRun {
  const Run& run;
  std::filesystem::path log;
};

std::vector<double> scan_times_s(const Run& run);

/// Throws std::runtime_error where the reference is not of this run.
Reference read_reference_input(const std::filesystem::path& csv, int sketch_height_px,
                               const NamedRun& run);

}  // namespace sketchloc

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

/// Adds --max-range-m and --allow-truncated, for commands that read a log.
void add_read_options(CLI::App& command, RunReading& reading);

/// Adds --polarity and --drawn, for commands that read a drawing: `of_what` begins their help.
void add_drawing_options(CLI::App& command, SketchReading& reading, const std::string& of_what);

/// Those of --polarity and --drawn that were given, as RunDescription::inputs.
std::vector<std::pair<std::string, std::string>> given_drawing_options(
    const SketchReading& reading);

}  // namespace sketchloc

#pragma once

#include "datasets/io/run_io.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

/// Adds --max-range-m and --allow-truncated, for commands that read a log.
void add_read_options(CLI::App& command, RunReading& reading);

}  // namespace sketchloc

#pragma once

namespace CLI {
class App;
}

namespace sketchloc {

/// `sketchloc generate`: simulated data sets, from generated buildings or from real maps.
void add_generate_command(CLI::App& program);

}  // namespace sketchloc

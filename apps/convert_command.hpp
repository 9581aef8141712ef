#pragma once

namespace CLI {
class App;
}

namespace sketchloc {

/// `sketchloc convert`: logs and drawings from one format to another.
void add_convert_command(CLI::App& program);

}  // namespace sketchloc

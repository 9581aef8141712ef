#pragma once

namespace CLI {
class App;
}

namespace sketchloc {

/// `sketchloc demo`: localizes the robot of the sample that comes with the project.
void add_demo_command(CLI::App& program);

}  // namespace sketchloc

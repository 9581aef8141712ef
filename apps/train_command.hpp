#pragma once

namespace CLI {
class App;
}

namespace sketchloc {

/// `sketchloc train`: networks for registration, from the simulator.
void add_train_command(CLI::App& program);

}  // namespace sketchloc

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "apps/program.hpp"
#include "apps/train_command.hpp"

namespace sketchloc {

/// Stands in where the program is built without training.
void add_train_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "train", "Train a network for registration (not in this build, see docs/training.md).");
  command->prefix_command();  // whatever the options, the message is the same
  command->callback([] {
    throw std::runtime_error(
        "this program was built without training; install libtorch-dev and libonnx-dev and "
        "configure with -D SKETCHLOC_TRAIN=ON");
  });
}

}  // namespace sketchloc

#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sketchloc {

/// The arguments (without the program's name) with those of the earlier run whose run.yaml
/// `--config` names, where it was of the same command: every option that the arguments neither
/// give nor exclude. Throws std::invalid_argument for an option that the command does not know.
std::vector<std::string> with_recorded_options(const CLI::App& program,
                                               std::vector<std::string> arguments);

}  // namespace sketchloc

#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/config_node.hpp"

namespace sketchloc {

/// What made a result: enough to make it again. Kept as run.yaml beside every result.
struct RunDescription {
  std::string command;  ///< subcommand
  std::uint64_t seed = 0;
  std::vector<std::pair<std::string, std::string>> inputs;  ///< flag without dashes, value as typed
  ConfigNode parameters;                                    ///< all of them, from to_config
};

/// The text of run.yaml: program, version, commit, then the description. It is a --config file too.
std::string run_file_text(const RunDescription& run);

}  // namespace sketchloc

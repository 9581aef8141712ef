#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/config_node.hpp"
#include "datasets/io/correspondence_io.hpp"

namespace sketchloc {

/// What made a result: enough to make it again. Kept as run.yaml beside every result.
struct RunDescription {
  std::string command;                ///< subcommand
  std::optional<std::uint64_t> seed;  ///< none: nothing was drawn
  /// Everything else that was given, in order: option without dashes, value as typed (`true` for a
  /// flag). An option that was given several times stands here as often.
  std::vector<std::pair<std::string, std::string>> inputs;
  ConfigNode parameters;                    ///< all of them, from to_config
  std::optional<PictureSize> drawing = {};  ///< that the run was in
};

/// The text of run.yaml: program, version, commit, then the description. It is a --config file too.
std::string run_file_text(const RunDescription& run);

/// Command and inputs, the seed among them, of a run.yaml; none where the file is something else.
std::optional<RunDescription> read_run_description(const std::filesystem::path& file);

}  // namespace sketchloc

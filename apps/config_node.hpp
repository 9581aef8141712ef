#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sketchloc {

/// Parameters as a tree of text: what a YAML file, the flags or a parameter struct say. A node is
/// a map of named nodes, in the order of its file or struct, or a value.
struct ConfigNode {
  bool is_map = false;
  std::string text = {};  ///< of a value
  std::string source =
      {};  ///< who said it, for errors: `tune.yaml:12`, `--seed`; empty for defaults
  std::vector<std::pair<std::string, ConfigNode>> children = {};  ///< of a map

  const ConfigNode* find(std::string_view key) const;
  /// The child with this key, added where there is none; this node becomes a map.
  ConfigNode& child(std::string_view key);
};

/// Reads a YAML file of nested maps and values. The run.yaml of an earlier run is a configuration
/// too: its `parameters` are taken here (its options: apps/recorded_options.hpp). Throws
/// std::invalid_argument with path and line.
ConfigNode read_config(const std::filesystem::path& path);

/// The tree as YAML text, two spaces per level.
std::string to_yaml(const ConfigNode& node);

/// The paths of all values, such as `beam_model.floor`.
std::vector<std::string> value_paths(const ConfigNode& node);

/// Sets the value at a path, with the maps on the way.
void set_value(ConfigNode& node, std::string_view path, ConfigNode value);

/// The tree without what is at these paths.
ConfigNode without(ConfigNode node, const std::vector<std::string>& paths);

/// `base` with every value that `top` states. Throws std::invalid_argument, naming source and
/// nearest known key, where `top` has a key that `base` has not, or a map in place of a value.
ConfigNode overlaid(ConfigNode base, const ConfigNode& top);

}  // namespace sketchloc

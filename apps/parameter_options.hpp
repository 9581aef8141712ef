#pragma once

#include <filesystem>
#include <functional>

#include "apps/config.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

/// What the command line says about parameters.
struct ParameterOptions {
  std::filesystem::path config_file;  ///< empty: none
  ConfigNode flags;                   ///< from `--beam_model.floor 0.2`
};

/// Adds --config, --print-parameters and one flag per parameter, named by its path and kept out of
/// --help. `options` must outlive the parsing.
void add_parameter_options(CLI::App& command, const ConfigNode& defaults,
                           ParameterOptions& options);

/// The same where the defaults depend on the options that were added before: `defaults` is called
/// once now, for the names, and again to print them.
void add_parameter_options(CLI::App& command, const std::function<ConfigNode()>& defaults,
                           ParameterOptions& options);

/// The parameters with precedence default < --config file < flag. Unknown names, wrong types and
/// values out of range throw std::invalid_argument with source, parameter and advice.
template <ParameterStruct T>
T parameters_from(const ParameterOptions& options, const T& defaults = {}) {
  ConfigNode node = to_config(defaults);
  if (!options.config_file.empty()) {
    node = overlaid(node, read_config(options.config_file));
  }
  return from_config<T>(overlaid(node, options.flags));
}

}  // namespace sketchloc

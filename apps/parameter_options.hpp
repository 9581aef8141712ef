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

/// `defaults`, replaced by what the --config file and the flags say, in this order. Unknown names
/// throw std::invalid_argument with source and advice.
ConfigNode stated_over(ConfigNode defaults, const ParameterOptions& options);

/// The parameters with precedence default < --config file < flag. Unknown names, wrong types and
/// values out of range throw std::invalid_argument with source, parameter and advice.
template <ParameterStruct T>
T parameters_from(const ParameterOptions& options, const T& defaults = {}) {
  return from_config<T>(stated_over(to_config(defaults), options));
}

}  // namespace sketchloc

#include "apps/parameter_options.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "apps/program.hpp"

namespace sketchloc {

void add_parameter_options(CLI::App& command, const ConfigNode& defaults,
                           ParameterOptions& options) {
  add_parameter_options(
      command, [defaults] { return defaults; }, options);
}

void add_parameter_options(CLI::App& command, const std::function<ConfigNode()>& defaults,
                           ParameterOptions& options) {
  command
      .add_option("--config", options.config_file,
                  "Parameters as YAML; run.yaml of an earlier run gives its other options too, "
                  "where the command line does not")
      ->group(kAlgorithmGroup)
      ->type_name("FILE");
  const auto print = [defaults] { throw CLI::CallForVersion(to_yaml(defaults()), 0); };
  command
      .add_flag_callback("--print-parameters", print,
                         "Print all parameters with their defaults; each is a flag too, "
                         "such as --group.name VALUE, and wins over the file")
      ->group(kAlgorithmGroup);
  for (const std::string& path : value_paths(defaults())) {
    const std::string flag = "--" + path;
    const auto set = [&options, path, flag](const std::string& text) {
      set_value(options.flags, path, {.text = text, .source = flag});
    };
    command.add_option_function<std::string>(flag, set)->group("");  // not in --help
  }
}

ConfigNode stated_over(ConfigNode defaults, const ParameterOptions& options) {
  if (!options.config_file.empty()) {
    defaults = overlaid(std::move(defaults), read_config(options.config_file));
  }
  return overlaid(std::move(defaults), options.flags);
}

}  // namespace sketchloc

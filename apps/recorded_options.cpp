#include "apps/recorded_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

#include "apps/run_file.hpp"

namespace sketchloc {
namespace {

constexpr std::string_view kConfig = "--config";

const CLI::App* chosen_command(const CLI::App& program, const std::vector<std::string>& arguments) {
  const auto commands = program.get_subcommands([](const CLI::App*) { return true; });
  for (const std::string& argument : arguments) {
    const auto named = std::ranges::find_if(
        commands, [&](const CLI::App* command) { return command->get_name() == argument; });
    if (named != commands.end()) {
      return *named;
    }
  }
  return nullptr;
}

std::optional<std::string> config_file(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == kConfig && i + 1 < arguments.size()) {
      return arguments[i + 1];
    }
    if (arguments[i].starts_with(std::string(kConfig) + "=")) {
      return arguments[i].substr(kConfig.size() + 1);
    }
  }
  return std::nullopt;
}

bool is_given(const CLI::App& command, const CLI::Option* option,
              const std::vector<std::string>& arguments) {
  return std::ranges::any_of(arguments, [&](const std::string& argument) {
    return argument.starts_with("-") &&
           command.get_option_no_throw(argument.substr(0, argument.find('='))) == option;
  });
}

/// Given itself, or one that it cannot stand beside.
bool is_decided(const CLI::App& command, const CLI::Option* option,
                const std::vector<std::string>& arguments) {
  const std::set<CLI::Option*> excluded = option->get_excludes();
  return is_given(command, option, arguments) ||
         std::ranges::any_of(excluded, [&](const CLI::Option* other) {
           return is_given(command, other, arguments);
         });
}

}  // namespace

std::vector<std::string> with_recorded_options(const CLI::App& program,
                                               std::vector<std::string> arguments) {
  const CLI::App* command = chosen_command(program, arguments);
  const std::optional<std::string> file = config_file(arguments);
  const std::optional<RunDescription> run = file ? read_run_description(*file) : std::nullopt;
  if (command == nullptr || !run || run->command != command->get_name()) {
    return arguments;
  }
  std::vector<std::string> recorded;
  for (const auto& [name, value] : run->inputs) {
    const CLI::Option* option = command->get_option_no_throw("--" + name);
    if (option == nullptr) {
      throw std::invalid_argument(*file + ": sketchloc " + run->command + " has no option --" +
                                  name + "; was the file written by another version?");
    }
    if (!is_decided(*command, option, arguments)) {
      recorded.push_back("--" + name + "=" + value);
    }
  }
  arguments.insert(arguments.end(), recorded.begin(), recorded.end());
  return arguments;
}

}  // namespace sketchloc

#include "apps/program.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/interrupt.hpp"
#include "apps/option_checks.hpp"
#include "apps/recorded_options.hpp"
#include "apps/version.hpp"

namespace sketchloc {
namespace {

constexpr int kDone = 0;
constexpr int kDataFailed = 1;
constexpr int kWrongUsage = 2;
constexpr int kInterrupted = 130;  // what a shell reports after Ctrl-C

void log_to_stderr() {
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  auto logger = std::make_shared<spdlog::logger>("sketchloc", std::move(sink));
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(logger);
}

/// Comes last, so that its group is the last one in --help.
void add_usability_options(CLI::App& command) {
  command.set_help_flag("-h,--help", "Print this help and exit")->group(kUsabilityGroup);
  const auto quiet = [] { spdlog::set_level(spdlog::level::warn); };
  const auto verbose = [] { spdlog::set_level(spdlog::level::debug); };
  command
      .add_flag_callback("-q,--quiet", quiet,
                         "No progress and no notes: results, warnings and errors only")
      ->group(kUsabilityGroup);
  command.add_flag_callback("-v,--verbose", verbose, "Say more")->group(kUsabilityGroup);
}

/// CLI11 turns the order of unknown arguments round and does not name hidden options (those of
/// parameters), whose value can be missing only at the end.
std::string message_of(const CLI::App& program, const CLI::ParseError& error,
                       const std::string& last_argument) {
  const std::string message = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    std::string unknown = "unknown:";
    for (const std::string& argument : program.remaining(true)) {
      unknown += " " + argument;
    }
    return unknown;
  }
  return message.starts_with(": ") ? last_argument + ": needs a value" : message;
}

int exit_code_of(const CLI::App& program, const CLI::ParseError& error,
                 const std::string& last_argument) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
    program.exit(error);  // prints help or version to stdout
    return kDone;
  }
  const auto chosen = program.get_subcommands();
  const bool unknown_command = chosen.empty() && program.remaining_size() > 0;
  const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
  std::cerr << "sketchloc" << command << ": "
            << (unknown_command ? "unknown command " + program.remaining().front()
                                : message_of(program, error, last_argument))
            << "\nRun sketchloc" << command << " --help for its options.\n";
  return kWrongUsage;
}

}  // namespace

void add_jobs_option(CLI::App& command, unsigned& jobs) {
  command
      .add_option("-j,--jobs", jobs,
                  "Threads, 0: one per core; the result does not depend on their number")
      ->check(whole_number())
      ->group(kUsabilityGroup)
      ->capture_default_str();
}

int run_program(int argc, const char* const* argv, std::span<const AddCommand> commands) {
  log_to_stderr();
  catch_interrupts();
  CLI::App program("Find a robot on a map that a person drew by hand.", "sketchloc");
  program.set_help_flag("");
  program.require_subcommand(1);
  for (const AddCommand add_command : commands) {
    add_command(program);
  }
  for (CLI::App* command : program.get_subcommands([](CLI::App*) { return true; })) {
    add_usability_options(*command);
  }
  program.set_help_flag("-h,--help", "Print this help and exit")->group(kUsabilityGroup);
  program.set_version_flag("--version", version_text(), "Print version and commit and exit")
      ->group(kUsabilityGroup);
  try {
    std::vector<std::string> arguments =
        with_recorded_options(program, {argv + std::min(argc, 1), argv + argc});
    std::ranges::reverse(arguments);  // as CLI11 wants them
    program.parse(std::move(arguments));
    return kDone;
  } catch (const CLI::ParseError& error) {
    return exit_code_of(program, error, argc > 0 ? argv[argc - 1] : "");
  } catch (const Interrupted& error) {
    spdlog::warn("{}", error.what());
    return kInterrupted;
  } catch (const std::invalid_argument& error) {
    spdlog::error("{}", error.what());
    return kWrongUsage;
  } catch (const std::filesystem::filesystem_error& error) {
    spdlog::error("{}: {}; check the path and who may use it", error.path1().string(),
                  error.code().message());
    return kDataFailed;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return kDataFailed;
  }
}

}  // namespace sketchloc

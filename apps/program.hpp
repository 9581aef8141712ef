#pragma once

#include <span>

namespace CLI {
class App;
}

namespace sketchloc {

// The three groups of --help.
inline constexpr char kAlgorithmGroup[] = "Algorithm";
inline constexpr char kOutputGroup[] = "Output";
inline constexpr char kUsabilityGroup[] = "Usability";

/// Adds one subcommand with its options and a callback that does the work.
using AddCommand = void (*)(CLI::App& program);

/// Adds --jobs, the number of threads as thread_count() (apps/parallel.hpp) takes it.
void add_jobs_option(CLI::App& command, unsigned& jobs);

/// Parses the command line, completed by what --config records of an earlier run, and runs the
/// subcommand. Messages go to stderr. Returns the exit code: 0 done, 1 the data failed
/// (std::exception), 2 wrong usage (a wrong command line, or std::invalid_argument from a
/// parameter), 130 interrupted.
int run_program(int argc, const char* const* argv, std::span<const AddCommand> commands);

}  // namespace sketchloc
